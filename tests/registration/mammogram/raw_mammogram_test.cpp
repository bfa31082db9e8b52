#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "registration/mammogram/mammogram_findings.h"
#include "registration/mammogram/mammogram_header.h"
#include "tests/registration/mammogram_dicom.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr int kColumns = 450, kRows = 600;
constexpr double kPixel_mm = 0.4, kDeep = 280, kHalfHeight = 270, kMiddle = 300;  // [pixels]

/// Nearer to the chest wall than 24 mm the thin skin there is lost by up to 6 mm [pixels].
constexpr double kEnds = 60;

struct Raw {
  bool monochrome1 = false, logarithmic = false, sign_said = false;
  double heel = 0;     ///< of the beam lost from chest wall to the far edge
  int collimated = 0;  ///< columns at the far edge that no X-rays reach
};

double thickness_mm(int column, int row) {
  const double r = std::hypot(column / kDeep, (row - kMiddle) / kHalfHeight);
  return r < 1 ? 50 * std::min(1., 8 * (1 - r)) : 0;  // flat between plates, round at the skin
}

/// Counts of a breast that absorbs 0.05 a mm, with the noise of 4,000 counts in air.
std::vector<Uint16> counts(const Raw& raw) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0, 1);
  std::vector<Uint16> pixels;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      double n =
          4000 * (1 - raw.heel * column / kColumns) * std::exp(-0.05 * thickness_mm(column, row));
      n = std::max(1., n + std::sqrt(n) * noise(random));
      if (column >= kColumns - raw.collimated) n = 1;
      pixels.push_back(raw.logarithmic ? std::lround(1000 * std::log(n) / std::log(10.))
                                       : std::lround(n));
    }
  return pixels;
}

void write(const fs::path& path, const Raw& raw) {
  DcmFileFormat file;
  DcmDataset& d = *file.getDataset();
  fill_mammogram(d);
  d.putAndInsertString(DCM_PresentationIntentType, "FOR PROCESSING");
  d.putAndInsertString(DCM_PhotometricInterpretation,
                       raw.monochrome1 ? "MONOCHROME1" : "MONOCHROME2");
  d.putAndInsertString(DCM_PixelIntensityRelationship, raw.logarithmic ? "LOG" : "LIN");
  if (raw.sign_said) d.putAndInsertSint16(DCM_PixelIntensityRelationshipSign, 1);
  d.putAndInsertUint16(DCM_Columns, kColumns);
  d.putAndInsertUint16(DCM_Rows, kRows);
  const std::vector<Uint16> pixels = counts(raw);
  d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
  ASSERT_TRUE(file.saveFile(path.c_str(), EXS_LittleEndianExplicit).good());
}

/// 20 raw images: both photometric interpretations, linear and logarithmic, with and without a heel
/// of 12 %, collimation, and the tag that says the sign.
std::vector<Raw> raw_images() {
  std::vector<Raw> all;
  for (const bool monochrome1 : {false, true})
    for (const bool logarithmic : {false, true})
      for (const auto& [heel, collimated, said] : {std::tuple{0., 0, false},
                                                   {0.12, 0, false},
                                                   {0.12, 30, false},
                                                   {0., 30, true},
                                                   {0.12, 30, true}})
        all.push_back({monochrome1, logarithmic, said, heel, collimated});
  return all;
}

TEST(RawMammogram, SkinIsFoundHoweverCountsAreStored) {
  const fs::path path = fs::temp_directory_path() / ("raw_" + std::to_string(getpid()) + ".dcm");
  ASSERT_EQ(raw_images().size(), 20u);
  for (const Raw& raw : raw_images()) {
    SCOPED_TRACE("monochrome1 " + std::to_string(raw.monochrome1) + " log " +
                 std::to_string(raw.logarithmic) + " heel " + std::to_string(raw.heel) +
                 " collimated " + std::to_string(raw.collimated) + " sign said " +
                 std::to_string(raw.sign_said));
    write(path, raw);
    try {
      const MammogramFindings found = find_breast(read_mammogram_dicom(path), kPixel_mm, false);
      double worst = 0;
      Eigen::Vector2d where(0, 0);
      for (const Eigen::Vector2d& x : found.outline) {
        const double off = std::abs(1 - std::hypot(x.x() / kDeep, (x.y() - kMiddle) / kHalfHeight));
        if (off <= worst || x.x() < kEnds) continue;
        worst = off;
        where = x;
      }
      // 2 % of the radius are 2 mm: half a pixel, and skin too thin to stand out of the noise.
      EXPECT_LT(worst, 0.02) << "at " << where.transpose();
      EXPECT_GT(found.outline.size(), 800u);  // all round: 340 mm
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  fs::remove(path);
}

}  // namespace
}  // namespace mammotwin
