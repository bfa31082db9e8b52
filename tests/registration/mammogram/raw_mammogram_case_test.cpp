#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "registration/mammogram/mammogram_findings.h"
#include "registration/mammogram/mammogram_pixels.h"
#include "tests/registration/mammogram/raw_mammogram.h"
#include "tests/registration/mammogram_dicom.h"

namespace mammotwin {
namespace {

constexpr int kVariations = 20;

/// Every way of storing, and exposures and breasts as they come.
RawMammogram variation(int n) {
  std::mt19937 random(100 + n);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  RawBreast b;
  b.oblique = n % 3 == 1;
  b.depth_mm = between(55, 125);
  b.half_height_mm = between(0.75, 1.05) * std::min(b.depth_mm + 10, 105.);
  b.thickness_mm = between(25, 80);
  b.rim_share = between(0.4, 0.8);
  b.gland = between(0.2, 0.9);
  RawExposure e;
  e.seed = 100 + n;
  e.logarithmic = n % 2;
  e.more_is_darker = n / 2 % 2;
  e.wall_right = n / 4 % 2;
  e.kvp = between(28, 32);
  e.open_counts = between(3000, 14000);
  e.electronic_noise = between(2, 6);
  e.dark_counts = n % 5 == 0 ? 50 : 0;
  e.bits = e.logarithmic ? 12 : 14;
  if (n == 6) e.open_counts = 18000;  // more than the converter counts
  if (n % 5 > 1) e.far_mm = between(5, 30);
  if (n % 5 > 2) e.top_mm = e.bottom_mm = between(3, 12);
  if (n % 5 == 4) e.wall_mm = between(2, 5);
  return raw_mammogram(b, e);
}

/// `says`: the header says in which direction values run.
void write_dicom(const RawMammogram& raw, bool monochrome_1, bool says,
                 const std::filesystem::path& path) {
  const RawExposure& e = raw.exposure;
  DcmFileFormat file;
  DcmDataset& d = *file.getDataset();
  fill_mammogram(d);
  d.putAndInsertString(DCM_SOPClassUID, UID_DigitalMammographyXRayImageStorageForProcessing);
  d.putAndInsertString(DCM_PresentationIntentType, "FOR PROCESSING");
  d.putAndInsertString(DCM_PhotometricInterpretation, monochrome_1 ? "MONOCHROME1" : "MONOCHROME2");
  d.putAndInsertString(DCM_PixelIntensityRelationship, e.logarithmic ? "LOG" : "LIN");
  if (says) d.putAndInsertSint16(DCM_PixelIntensityRelationshipSign, e.more_is_darker ? -1 : 1);
  d.putAndInsertUint16(DCM_BitsStored, e.bits);
  d.putAndInsertUint16(DCM_HighBit, e.bits - 1);
  d.putAndInsertUint16(DCM_Columns, e.columns);
  d.putAndInsertUint16(DCM_Rows, e.rows);
  d.putAndInsertUint16Array(DCM_PixelData, raw.values.data(), raw.values.size());
  ASSERT_TRUE(file.saveFile(path.c_str(), EXS_LittleEndianExplicit).good());
}

/// Largest distance of the outline's points from the true skin [mm], nipple and what is not exposed
/// left out; infinite where nothing is left.
double worst_mm(const RawMammogram& raw, const MammogramFindings& found) {
  constexpr double kNipple_mm = 14, kEdge_mm = 3;
  const double pixel = raw.exposure.pixel_mm;
  const Eigen::Vector2d nipple(raw.nipple_column(), raw.nipple_row());
  double worst = 0;
  int compared = 0;
  for (const Eigen::Vector2d& x : found.outline) {
    if ((x - nipple).norm() * pixel < kNipple_mm || !raw.is_exposed(x.x(), x.y(), kEdge_mm))
      continue;
    worst = std::max(worst, std::abs(raw.outside_mm(x.x(), x.y())));
    ++compared;
  }
  constexpr int kLeast = 100;  // 40 mm of skin
  return compared > kLeast ? worst : std::numeric_limits<double>::infinity();
}

/// Share of the rows between the breast's ends that the outline covers.
double covered(const RawMammogram& raw, const MammogramFindings& found) {
  int inside = 0, met = 0;
  const int wall = raw.exposure.wall_right ? raw.exposure.columns - 1 : 0;
  const int in = raw.exposure.wall_right ? -1 : 1;
  const int deep = wall + in * static_cast<int>(10 / raw.exposure.pixel_mm);
  for (int row = 0; row < raw.exposure.rows; ++row) {
    if (!raw.is_exposed(deep, row, 3) || raw.outside_mm(deep, row) > 0) continue;
    ++inside;
    met += found.outline.front().y() <= row && row <= found.outline.back().y();
  }
  return inside > 0 ? double(met) / inside : 0;
}

TEST(RawMammogram, SkinIsFoundHoweverCountsAreStored) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("raw_" + std::to_string(getpid()) + ".dcm");
  for (int n = 0; n < kVariations; ++n) {
    const RawMammogram raw = variation(n);
    write_dicom(raw, n / 8 % 2, n % 3 > 0, path);
    try {
      const MammogramFindings found =
          find_breast(read_mammogram_dicom(path), raw.exposure.pixel_mm, raw.breast.oblique);
      EXPECT_LT(worst_mm(raw, found), 3) << n;
      EXPECT_GT(covered(raw, found), 0.95) << n;
    } catch (const std::runtime_error& error) {
      ADD_FAILURE() << n << ": " << error.what();
    }
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace mammotwin
