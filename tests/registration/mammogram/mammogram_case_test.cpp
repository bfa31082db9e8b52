#include <gtest/gtest.h>

#include <filesystem>

#include "registration/mammogram/mammogram_findings.h"
#include "registration/mammogram/mammogram_picture.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr double kPixel_mm = 0.1;  // no header says it; so wide the image is a usual detector

/// Centres of the markers, measured once in the images by eye and by their saturated discs' extent.
TEST(MammogramFindings, RealViewsHaveTheirNippleAndMuscle) {
  const fs::path folder = fs::path(MAMMOTWIN_CASES) / "mammograms";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const std::pair<const char*, Eigen::Vector2d> views[] = {{"R-CC", {1120, 1521}},
                                                           {"L-CC", {1302, 1550}},
                                                           {"R-MLO", {1131, 2201}},
                                                           {"L-MLO", {1344, 2148}}};
  for (const auto& [name, marker] : views) {
    const bool oblique = std::string(name).find("MLO") != std::string::npos;
    const MammogramFindings found = find_breast(
        read_mammogram_picture(folder / (std::string(name) + ".png")), kPixel_mm, oblique);
    EXPECT_EQ(found.chest_wall, ImageEdge::left) << name;
    EXPECT_LT((found.nipple - marker).norm(), 3) << name;
    EXPECT_EQ(found.pectoral.has_value(), oblique) << name;
    EXPECT_EQ(found.view_doubt, "") << name;
    EXPECT_GT(found.outline.size(), 500u) << name;  // 200 mm and more, a point every 0.4
  }
}

}  // namespace
}  // namespace mammotwin
