#include <fstream>
#include <nlohmann/json.hpp>

#include "segmentation/segment.h"
#include "tests/segmentation/cases.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

Eigen::Vector3d point(const nlohmann::json& x) {
  return {x[0].get<double>(), x[1].get<double>(), x[2].get<double>()};
}

/// The synthetic patient's lesions, from points 4 mm off, within 2 mm.
TEST(SampleData, LesionsOf042AreRecovered) {
  const std::filesystem::path folder =
      std::filesystem::path(MAMMOTWIN_SOURCE_DIR) / "sample_data" / "042";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const auto truth = nlohmann::json::parse(std::ifstream(folder / "truth.json"));
  SegmentInput input;
  input.mri = folder / "mri.nrrd";
  for (const auto& lesion : truth.at("lesions")) {
    LesionSeed& seed = input.lesions.emplace_back();
    seed.id = lesion.at("id");
    seed.point_in_lps = point(lesion.at("clicked_lps_mm"));
  }
  const SegmentResult result = segment(input, {});
  EXPECT_EQ(result.quality.status, SegmentStatus::ok);
  for (std::size_t n = 0; n < truth.at("lesions").size(); ++n) {
    const auto& lesion = truth.at("lesions")[n];
    const Lesion& found = result.quality.lesions.at(n);
    EXPECT_LT((found.centroid_in_lps - point(lesion.at("centroid_lps_mm"))).norm(), 1);
    EXPECT_NEAR(found.volume_ml / lesion.at("volume_ml").get<double>(), 1, 0.25);
  }
  EXPECT_NEAR(result.quality.breast_volume_ml / truth.at("breast_volume_ml").get<double>(), 1,
              0.05);
  EXPECT_LT((result.quality.nipple_in_lps - point(truth.at("nipple_lps_mm"))).norm(), 3);
  EXPECT_NEAR(result.quality.skin_thickness_mm, truth.at("skin_thickness_mm").get<double>(), 0.5);
}

}  // namespace
}  // namespace mammotwin
