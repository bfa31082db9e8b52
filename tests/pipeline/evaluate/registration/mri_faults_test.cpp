#include "pipeline/evaluate/registration/mri_faults.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace mammotwin {
namespace {

/// A left breast of 100 x 60 x 90 mm in front of a plane of muscle at y = 10 mm.
Segmentation square_breast() {
  Segmentation s;
  s.labels = Volume<std::uint8_t>({120, 90, 110}, {1, 1, 1}, {0, -60, -55}, label::air);
  s.region = {Side::left, 10, 110, -45, 45};
  for (int k = 0; k < 110; ++k)
    for (int j = 0; j < 90; ++j)
      for (int i = 0; i < 120; ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        if (x.y() > 10)
          s.labels(i, j, k) = label::muscle;
        else if (x.y() > -50 && s.region.contains(x))
          s.labels(i, j, k) = label::fat;
      }
  s.nipple_in_lps = {60, -50, 0};
  return s;
}

TEST(MriFaults, TheRegionLosesItsFlank) {
  Segmentation s = square_breast();
  const auto width = [&] {
    const nlohmann::json roi = region_without_flank(s, 0.1).at("markups").at(0);
    EXPECT_NEAR(roi.at("center")[0].get<double>() - roi.at("size")[0].get<double>() / 2, 10, 1e-9);
    EXPECT_NEAR(roi.at("size")[2].get<double>(), 90, 1e-9);
    return roi.at("size")[0].get<double>();
  };
  EXPECT_NEAR(width(), 90, 1.5);  // a voxel
  s.lesions = {{"L1", {98, 0, 0}, 1}};
  EXPECT_NEAR(width(), 98, 1e-9) << "the lesion is out";
}

TEST(MriFaults, TheWallLeavesTheTruthTowardsTheFlank) {
  const nlohmann::json curves = wall_off_laterally(square_breast(), 5).at("markups");
  EXPECT_EQ(curves.size(), 3);  // of 110 mm, where the region is
  for (const nlohmann::json& curve : curves)
    for (const nlohmann::json& point : curve.at("controlPoints")) {
      const double x = point.at("position")[0], y = point.at("position")[1];
      const double share = std::max(0., (x - 60) / 50);
      EXPECT_NEAR(y, 10.5 + 5 * share, 1e-9) << x;
    }
}

}  // namespace
}  // namespace mammotwin
