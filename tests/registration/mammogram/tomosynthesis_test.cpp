#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <vector>

#include "registration/mammogram/header_geometry.h"
#include "registration/mammogram/mammogram_pixels.h"
#include "tests/registration/mammogram_dicom.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr int kColumns = 40, kRows = 60, kFrames = 4;

DcmItem& item_in(DcmItem& parent, const DcmTagKey& sequence, long n = -2) {
  DcmItem* item = nullptr;
  parent.findOrCreateSequenceItem(sequence, item, n);
  return *item;
}

/// A left CC of four slices 5 mm apart, frame n all of grey 100 n but for what lies behind.
struct Volume4 {
  bool up = true;             ///< positions go from the support to the paddle
  bool positions = true;      ///< there are any
  bool acquisition = true;    ///< thickness and distances stand in its sequence
  const char* between = "5";  ///< SpacingBetweenSlices
};

void fill_volume(DcmDataset& d, const Volume4& v) {
  fill_mammogram(d);
  for (const DcmTagKey& tag :
       {DCM_ImagerPixelSpacing, DCM_ViewPosition, DCM_ImageLaterality, DCM_PatientOrientation,
        DCM_PositionerPrimaryAngle, DCM_BodyPartThickness, DCM_DistanceSourceToDetector,
        DCM_DistanceSourceToPatient, DCM_EstimatedRadiographicMagnificationFactor})
    d.findAndDeleteElement(tag);
  d.putAndInsertString(DCM_SOPClassUID, UID_BreastTomosynthesisImageStorage);
  item_in(d, DCM_ViewCodeSequence).putAndInsertString(DCM_CodeValue, "399162004");
  DcmItem& shared = item_in(d, DCM_SharedFunctionalGroupsSequence);
  DcmItem& measures = item_in(shared, DCM_PixelMeasuresSequence);
  measures.putAndInsertString(DCM_PixelSpacing, "0.1\\0.1");
  if (v.between) measures.putAndInsertString(DCM_SpacingBetweenSlices, v.between);
  item_in(shared, DCM_PlaneOrientationSequence)
      .putAndInsertString(DCM_ImageOrientationPatient, "0\\-1\\0\\-1\\0\\0");
  item_in(shared, DCM_FrameAnatomySequence).putAndInsertString(DCM_FrameLaterality, "L");
  for (int n = 0; n < kFrames; ++n) {
    DcmItem& frame = item_in(d, DCM_PerFrameFunctionalGroupsSequence, n);
    const double height = 5. * (v.up ? n : kFrames - 1 - n) - 300;  // of any origin
    if (v.positions)
      item_in(frame, DCM_PlanePositionSequence)
          .putAndInsertString(DCM_ImagePositionPatient,
                              ("150\\80\\" + std::to_string(height)).c_str());
  }
  if (v.acquisition) {
    DcmItem& acquisition = item_in(d, DCM_XRay3DAcquisitionSequence);
    acquisition.putAndInsertString(DCM_BodyPartThickness, "21");
    acquisition.putAndInsertString(DCM_DistanceSourceToDetector, "700");
    for (int n = 0; n < 3; ++n)
      item_in(acquisition, DCM_PerProjectionAcquisitionSequence, n)
          .putAndInsertFloat64(DCM_PositionerPrimaryAngle, 7.5 * (n - 1) + 2);
  }
  d.putAndInsertString(DCM_NumberOfFrames, std::to_string(kFrames).c_str());
  std::vector<Uint16> pixels;
  for (int n = 1; n <= kFrames; ++n) pixels.insert(pixels.end(), kColumns * kRows, 100 * n);
  d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
}

class Tomosynthesis : public ::testing::Test {
 protected:
  Tomosynthesis() : path_(fs::temp_directory_path() / ("tomo_" + std::to_string(getpid()))) {}
  ~Tomosynthesis() override { fs::remove(path_); }

  void write(const Volume4& volume, const std::function<void(DcmDataset&)>& change = {}) const {
    DcmFileFormat file;
    fill_volume(*file.getDataset(), volume);
    if (change) change(*file.getDataset());
    ASSERT_TRUE(file.saveFile(path_.c_str(), EXS_LittleEndianExplicit).good());
  }
  HeaderGeometry read(const Volume4& volume, const HeaderOverrides& overrides = {}) const {
    write(volume);
    return header_geometry(read_mammogram_header(path_), "cc", Side::left, overrides);
  }
  std::string refusal(const Volume4& volume, const HeaderOverrides& overrides = {}) const {
    try {
      read(volume, overrides);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }
  fs::path path_;
};

TEST_F(Tomosynthesis, GeometryComesFromFunctionalGroupsAndAcquisition) {
  const HeaderGeometry g = read({});
  EXPECT_NEAR(g.angle_deg, 2, 1e-9);  // the middle of -5.5, 2 and 9.5
  EXPECT_EQ(g.thickness_mm, 21);
  EXPECT_EQ(g.detector.pixels->spacing_mm, 0.1);
  EXPECT_EQ(g.detector.pixels->chest_wall, ImageEdge::left);
  EXPECT_TRUE(g.detector.pixels->lateral_at_top);  // rows run to the right, medially
  ASSERT_TRUE(g.detector.slices);
  EXPECT_EQ(g.detector.slices->count, kFrames);
  EXPECT_NEAR(g.detector.slices->spacing_mm, 5, 1e-6);
  EXPECT_TRUE(g.detector.slices->first_at_support);
  // The lowest slice's middle lies half a slice high: 12.5 mm is that of the third.
  EXPECT_NEAR(g.detector.slices->slice_at(12.5), 3, 1e-6);
}

TEST_F(Tomosynthesis, SlicesThatGoDownCountFromThePaddle) {
  const HeaderGeometry g = read({.up = false});
  EXPECT_FALSE(g.detector.slices->first_at_support);
  EXPECT_NEAR(g.detector.slices->slice_at(12.5), 2, 1e-6);
}

TEST_F(Tomosynthesis, PixelsHaveOneSizeAtAnyHeight) {
  const Detector detector = read({}).detector;
  const Eigen::Vector2d low = detector.project({20, 10, 0}), high = detector.project({20, 10, 60});
  EXPECT_LT((low - high).norm(), 1e-3);
  EXPECT_LT((low - Eigen::Vector2d(20, 10)).norm(), 1e-3);
  HeaderOverrides along_rays;
  along_rays.source_distance_mm = 700;
  EXPECT_GT(read({}, along_rays).detector.project({20, 10, 60}).x(), 21);  // times 700/640
}

TEST_F(Tomosynthesis, WhatItsHeaderLacksIsAskedFor) {
  EXPECT_NE(refusal({.positions = false}).find("views.cc.detector.first_slice"), std::string::npos);
  HeaderOverrides first;
  first.slices.first_at_support = false;
  EXPECT_EQ(read({.positions = false}, first).detector.slices->spacing_mm, 5);
  EXPECT_NE(refusal({.positions = false, .between = nullptr}, first)
                .find("views.cc.detector.slice_spacing_mm"),
            std::string::npos);
  first.slices.lowest_mm = 4;
  EXPECT_EQ(read({.positions = false}, first).detector.slices->lowest_mm, 4);
}

TEST_F(Tomosynthesis, OfOtherKindsSeveralFramesAreRefused) {
  write({}, [](DcmDataset& d) {
    d.putAndInsertString(DCM_SOPClassUID, UID_BreastProjectionXRayImageStorageForPresentation);
    d.putAndInsertString(DCM_ImageLaterality, "L");
  });
  try {
    header_geometry(read_mammogram_header(path_), "cc", Side::left);
    ADD_FAILURE() << "projections were taken for a volume";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("NumberOfFrames"), std::string::npos) << error.what();
  }
  write({}, [](DcmDataset& d) {
    d.findAndDeleteElement(DCM_PerFrameFunctionalGroupsSequence);
    d.findAndDeleteElement(DCM_SharedFunctionalGroupsSequence);
  });
  EXPECT_THROW(read_mammogram_header(path_), std::runtime_error);
}

TEST_F(Tomosynthesis, IsSeenAsTheMeanOfItsSlicesAndSliceBySlice) {
  write({});
  const MammogramImage mean = read_mammogram(path_);
  EXPECT_EQ(mean.columns, kColumns);
  EXPECT_EQ(mean.rows, kRows);
  EXPECT_EQ(mean.at(3, 5), 250);  // of 100, 200, 300, 400
  EXPECT_EQ(read_mammogram_slice(path_, 3).at(3, 5), 300);
  EXPECT_THROW(read_mammogram_slice(path_, 5), std::runtime_error);
}

}  // namespace
}  // namespace mammotwin
