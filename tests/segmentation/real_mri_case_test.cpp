#include <fstream>
#include <nlohmann/json.hpp>

#include "segmentation/segment.h"
#include "tests/segmentation/cases.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Radiologist {
  SegmentInput input;
  std::vector<Eigen::Vector3d> centroids;
};

Radiologist read_case(const fs::path& folder) {
  Radiologist r;
  r.input.mri = folder / "mri";
  const auto json = nlohmann::json::parse(std::ifstream(folder / "lesions_radiologist.json"));
  for (const auto& lesion : json.at("mri")) {
    const auto& x = lesion.at("centroid_lps_mm");
    r.centroids.emplace_back(x[0].get<double>(), x[1].get<double>(), x[2].get<double>());
    LesionSeed& seed = r.input.lesions.emplace_back();
    seed.id = "L" + std::to_string(r.centroids.size());
    seed.point_in_lps = r.centroids.back();
  }
  return r;
}

/// Contours are drawn in one slice: a lesion's centroid may lie some way off along z.
void expect_lesions_near(const Radiologist& r, const SegmentResult& result) {
  ASSERT_EQ(result.segmentation.lesions.size(), r.centroids.size());
  for (std::size_t n = 0; n < r.centroids.size(); ++n)
    EXPECT_LT((result.segmentation.lesions[n].centroid_in_lps - r.centroids[n]).norm(), 4);
}

TEST(RealMri, FirstPatient) {
  MAMMOTWIN_NEED_CASE(folder, "mimbcd_6e4da81a");
  const Radiologist r = read_case(folder);
  const SegmentResult result = segment(r.input, {});
  EXPECT_EQ(result.quality.contrast, "fat-suppressed");
  EXPECT_EQ(result.quality.side, Side::left);
  EXPECT_LT(*result.quality.chest_wall_doubt, 0.15);
  EXPECT_EQ(result.quality.status, SegmentStatus::look) << "suppression failed in 17 ml";
  // By eye the nipple is the tip at (77, -79, -14).
  EXPECT_LT((result.quality.nipple_in_lps - Eigen::Vector3d(77, -79, -14)).norm(), 4);
  expect_lesions_near(r, result);
}

TEST(RealMri, SecondPatient) {
  MAMMOTWIN_NEED_CASE(folder, "mimbcd_8af60052");
  const Radiologist r = read_case(folder);
  const SegmentResult result = segment(r.input, {});
  EXPECT_EQ(result.quality.contrast, "fat-suppressed");
  EXPECT_LT(*result.quality.chest_wall_doubt, 0.15);
  EXPECT_GT(*result.quality.failed_suppression_ml, 10) << "a bright patch below the middle";
  expect_lesions_near(r, result);
}

SegmentResult segmented(const fs::path& file, Side side,
                        const std::optional<Eigen::Vector3d>& lesion = std::nullopt) {
  SegmentInput input;
  input.mri = file;
  input.side = side;
  if (lesion) input.lesions.emplace_back().id = "L1", input.lesions[0].point_in_lps = lesion;
  return segment(input, {});
}

TEST(RealMri, GhostsBesideTheBodyTakeNoBreastAway) {
  MAMMOTWIN_NEED_CASE(folder, "mimbcd_6668654d");
  const SegmentResult result =
      segmented(folder / "series_9.nrrd", Side::left, Eigen::Vector3d(39.9, 35.5, 27.2));
  EXPECT_NE(result.quality.status, SegmentStatus::refused);
  EXPECT_LT(*result.quality.pendant_outside, 0.05);
  // By eye the breast hangs between x = 15 and 70 mm, from z = -70 to 75 mm.
  const BreastRegion& region = result.segmentation.region;
  EXPECT_LT(region.x_min, 18);
  EXPECT_GT(region.x_max, 70);
  EXPECT_GT(region.z_max, 75);
}

TEST(RealMri, ARetractedNippleBesideATumourIsSeenByItsPapilla) {
  MAMMOTWIN_NEED_CASE(folder, "mimbcd_e08feb68");
  const SegmentResult result =
      segmented(folder / "series_8.nrrd", Side::left, Eigen::Vector3d(74.4, 38.6, 3.7));
  // By eye it is the tip at (83, -1, -10); what it shows is as bright as skin 30 mm below.
  EXPECT_LT((result.quality.nipple_in_lps - Eigen::Vector3d(83, -1, -10)).norm(), 6);
}

TEST(RealMri, LiverAndHeartAreNoChestWall) {
  MAMMOTWIN_NEED_CASE(folder, "mimbcd_d1f3d33d");
  const Segmentation late = segmented(folder / "series_24.nrrd", Side::left).segmentation;
  // By eye the pectoral's front in axial slices at x = 60 mm, over heart and liver.
  for (const Eigen::Vector3d& front :
       {Eigen::Vector3d(60, 72, -64), Eigen::Vector3d(60, 68, -39), Eigen::Vector3d(60, 71, -14)}) {
    const Eigen::Vector3d off(0, 7, 0);  // 3 mm at most are asked for; and a voxel
    const auto at = [&](const Eigen::Vector3d& x) {
      const Eigen::Vector3i v = late.labels.index(x).array().round().cast<int>();
      return late.labels(v.x(), v.y(), v.z());
    };
    EXPECT_EQ(at(front + off), label::muscle) << front.transpose();
    EXPECT_NE(at(front - off), label::muscle) << front.transpose();
  }
}

TEST(RealMri, NamesTheHeaderNowhere) {
  MAMMOTWIN_NEED_CASE(folder, "odd_inputs");
  SegmentInput input;
  input.side = Side::left;
  for (const char* name : {"BRMULTI", "emri_small.dcm", "breast1_image.nrrd",
                           "implant_silicone_only.nrrd", "gap_series"}) {
    input.mri = folder / name;
    try {
      segment(input, {});
      ADD_FAILURE() << name << " was not refused";
    } catch (const std::exception& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(name), std::string::npos) << message;
      EXPECT_EQ(message.find("1.2.826"), std::string::npos) << message;  // a UID
      EXPECT_EQ(message.find('^'), std::string::npos) << message;        // a DICOM name
    }
  }
}

}  // namespace
}  // namespace mammotwin
