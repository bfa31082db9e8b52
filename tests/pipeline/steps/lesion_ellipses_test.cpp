#include "pipeline/steps/lesion_ellipses.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

ProjectedFindings at_depths(const std::vector<double>& depths_mm) {
  ProjectedFindings findings;
  for (const double depth : depths_mm) {
    findings.lesions.emplace_back();
    findings.lesions.back().landmark.id = "L" + std::to_string(findings.lesions.size());
    findings.lesions.back().on_detector.x() = depth;
  }
  return findings;
}

// An ellipse of 20 by 5 mm along depth reaches 12 mm in front of the edge from 8 mm behind it; one
// across it does not.
TEST(EdgeRemarks, SayWhetherAMammogramMayShowALesionBehindItsEdge) {
  std::vector<LesionEllipse> ellipses(3);
  ellipses[0].on_detector = {20, 5, 0};
  ellipses[1].on_detector = {20, 5, 90};
  ellipses[2].on_detector = {20, 5, 0};
  const auto remarks = edge_remarks(at_depths({-8, -8, 3}), ellipses, "cc");
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_EQ(remarks[0],
            "lesion L1 is predicted 8 mm behind the detector's edge in cc, its 90 % ellipse 12 mm "
            "in front of it: that mammogram may not show it");
  EXPECT_EQ(remarks[1],
            "lesion L2 is predicted 8 mm behind the detector's edge in cc: that mammogram would "
            "not show it");
}

TEST(EdgeRemarks, NeedNoEllipse) {
  const auto remarks = edge_remarks(at_depths({-2}), {}, "mlo");
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("in mlo: that mammogram would not show it"), std::string::npos);
}

}  // namespace
}  // namespace mammotwin
