#include "pipeline/evaluate/calibration/tissue_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/calibration/womens_moves.h"
#include "segmentation/segmentation_file.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

TEST(MiddleHalf, IsTheMeanOfWhatLiesBetweenTheQuarters) {
  const MiddleHalf of_eight = middle_half({100, 1, 3, 2, 4, 5, 6, -90});
  EXPECT_DOUBLE_EQ(of_eight.mean, 3.5);  // of 2, 3, 4, 5
  EXPECT_EQ(of_eight.weights[0], 0);
  EXPECT_DOUBLE_EQ(of_eight.weights[2], 0.25);
  // Of three the outer ones count by a quarter each.
  EXPECT_DOUBLE_EQ(middle_half({1, 10, 4}).mean, (0.25 * 1 + 4 + 0.25 * 10) / 1.5);
  EXPECT_DOUBLE_EQ(middle_half({7}).mean, 7);
}

TEST(TissueNumbers, AKeyThatIsNoneIsNamedWithThoseThatAre) {
  try {
    tissue_numbers({"materials.skin.c1_kpa", "materials.fat.c1_kpa"});
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("materials.fat.c1_kpa cannot be calibrated"), std::string::npos) << text;
    EXPECT_NE(text.find("materials.stiffness_factor"), std::string::npos) << text;
  }
}

class TissueCalibration : public ScratchFolder {
 protected:
  /// A dome as imaged, all fat.
  CalibratedBreast dome(const std::string& thickness_mm = "85") const {
    write_mesh_file(folder_ / "prone.vtu", dome_breast({2, 2, 1}));
    Segmentation all_fat;
    all_fat.labels = Volume<std::uint8_t>({40, 40, 40}, {4, 4, 4}, {-80, -80, -80}, label::fat);
    all_fat.fractions = all_fat.labels.like<Fractions>({1, 0, 0});
    all_fat.region = {Side::left, -70, 70, -70, 70};
    all_fat.nipple_in_lps = {0, -63, 0};
    write_segmentation(folder_ / "segmentation.seg.nrrd", all_fat);
    write_fractions(folder_ / "fractions.nrrd", all_fat.fractions);
    write("patient.toml",
          "side = \"left\"\n[materials]\npreset = \"real\"\nstiffness_factor = 0.4\n"
          "[views.cc]\nthickness_mm = " +
              thickness_mm + "\n");
    return CalibratedBreast(folder_);
  }
};

TEST_F(TissueCalibration, SlopesAreThoseOfBreastsSolvedAnew) {
  CalibratedBreast breast = dome();
  const auto numbers =
      tissue_numbers({"materials.stiffness_factor", "materials.*.stiffening",
                      "materials.*.most_stiffening", "compress.chest_wall_spring_kpa_per_mm"});
  const std::vector<double> values{0.4, 2, 6, 0.04};
  breast.solve(numbers, values);
  const std::vector<BreastFigures> slopes = breast.slopes();
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    constexpr double step = 0.02;
    const auto figures = [&](double log_change) {
      std::vector<double> there = values;
      there[n] *= std::exp(log_change);
      return breast.solve(numbers, there);
    };
    const BreastFigures below = figures(-step), above = figures(step);
    for (int i = 0; i < kBreastFigures; ++i) {
      const double solved = (above[i] - below[i]) / (2 * step);
      // Coulomb's friction remembers the way to a state; a median's slope is that of few points.
      const double tolerance = i == kLogForce ? 0.1 : i < kLandmark ? 1e-3 : 0.02;
      EXPECT_NEAR(slopes[n][i], solved, tolerance * std::max(1.0, std::abs(solved)))
          << numbers[n].key << " " << i;
    }
  }
}

// What the dome does with other numbers is asked of it: these must be found again.
TEST_F(TissueCalibration, FindsTheNumbersThatTheDataAreOf) {
  std::vector<CalibratedBreast> breasts;
  breasts.push_back(dome());
  const auto numbers =
      tissue_numbers({"materials.stiffness_factor", "compress.chest_wall_spring_kpa_per_mm"});
  const std::vector<double> truth{0.5, 0.03};
  const BreastFigures figures = breasts.front().solve(numbers, truth);
  CalibrationData data;
  for (int i = 0; i < kPopulationMeans; ++i)
    data[i] = i < kLogForce ? CalibrationDatum{figures[i], 0.1}
                            : CalibrationDatum{figures[kLogForce], 0.05};
  const Calibration found = calibrate_tissue(breasts, numbers, data, 1, [](const std::string&) {});
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const CalibratedNumber& number = found.numbers[n];
    EXPECT_NEAR(number.value, truth[n], 0.02 * truth[n]) << number.number.key << " " << found.ended;
    ASSERT_TRUE(number.low && number.high);
    EXPECT_LT(*number.low, truth[n]);
    EXPECT_GT(*number.high, truth[n]);
  }
}

TEST_F(TissueCalibration, ForcesAreThoseOfThinAndOfThickBreasts) {
  std::vector<CalibratedBreast> breasts;
  for (const char* thickness_mm : {"90", "80"}) breasts.push_back(dome(thickness_mm));
  const auto numbers = tissue_numbers({"materials.stiffness_factor"});
  std::vector<double> forces;
  for (CalibratedBreast& breast : breasts)
    forces.push_back(breast.solve(numbers, {0.4})[kLogForce]);
  EXPECT_GT(forces[1], forces[0]) << "as it is pressed thinner";
  CalibrationData data;
  data.fill({0, 1e6});
  data[kLogForceOfThin] = {forces[1], 0.05};
  data[kLogForceOfThick] = {forces[0], 0.05};
  const Calibration found = calibrate_tissue(breasts, numbers, data, 1, [](const std::string&) {});
  EXPECT_NEAR(found.start[kLogForceOfThin], forces[1], 1e-9);
  EXPECT_NEAR(found.start[kLogForceOfThick], forces[0], 1e-9);
  EXPECT_NEAR(found.numbers.front().value, 0.4, 0.004) << found.ended;
}

TEST_F(TissueCalibration, ReadsWhatWomenDo) {
  const std::string header =
      "woman,point,side,prone_l_mm,prone_p_mm,prone_s_mm,supine_l_mm,supine_p_mm,supine_s_mm,"
      "prone_to_ribs_mm,prone_to_skin_mm,supine_to_ribs_mm,supine_to_skin_mm\n";
  write("points.csv", header +
                          "1,nipple,left,60,-90,0,100,-10,0,,,,\n"
                          "1,nipple,right,-60,-90,0,-120,-20,0,,,,\n"
                          "1,landmark1,left,80,-50,0,80,-10,30,20,10,15,10\n"
                          "2,landmark1,left,80,-50,0,80,-40,0,20,10,25,10\n"
                          "3,landmark1,left,80,-50,0,80,70,0,61,10,45,10\n");
  const WomensMoves moves = read_womens_moves(folder_ / "points.csv");
  EXPECT_DOUBLE_EQ(moves.lateral.middle, 50);
  EXPECT_DOUBLE_EQ(moves.posterior.middle, 75);
  EXPECT_EQ(moves.lateral.women, 1);
  EXPECT_DOUBLE_EQ(moves.landmark.middle, 30);  // of 50 and 10; the third lies too far forward
  EXPECT_EQ(moves.landmark.women, 2);
  EXPECT_DOUBLE_EQ(moves.ribs.middle, 20);
  write("points.csv", "woman,point\n1,nipple\n");
  EXPECT_THROW(read_womens_moves(folder_ / "points.csv"), std::runtime_error);
}

}  // namespace
}  // namespace mammotwin
