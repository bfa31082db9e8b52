#include "pipeline/steps/unload_quality.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

/// Gravity came off up to that share of it, with tissue at 0.2 of its stiffness.
UnloadingRecord taken_off(double share) {
  UnloadingRecord record;
  record.stiffness_factor = 0.2;
  record.report.converged = share == 1;
  record.report.gravity_fraction = share;
  record.report.reason = share == 1 ? "" : "the imaged shape is not stable under its weight";
  stiffen_as_needed(record);
  return record;
}

void expect_only_doubt(const UnloadingRecord& record, const std::string& part) {
  const Outcome outcome = judge_unloading(record);
  EXPECT_EQ(outcome.status, Status::look);
  ASSERT_EQ(outcome.reasons.size(), 1u);
  EXPECT_NE(outcome.reasons[0].find(part), std::string::npos) << outcome.reasons[0];
}

TEST(UnloadQuality, TissueThatHangsStaysAsItWasSet) {
  const UnloadingRecord record = taken_off(1);
  EXPECT_EQ(record.stiffness_factor, 0.2);
  EXPECT_EQ(record.stiffened, 1);
  EXPECT_EQ(judge_unloading(record).status, Status::ok);
}

TEST(UnloadQuality, TissueALittleTooSoftIsStiffened) {
  const UnloadingRecord record = taken_off(0.9);
  EXPECT_DOUBLE_EQ(record.stiffness_factor, 0.2 / 0.9);
  const Outcome outcome = judge_unloading(record);
  EXPECT_EQ(outcome.status, Status::ok);
  EXPECT_EQ(outcome.quality.at("gravity_factor"), 1);
  EXPECT_DOUBLE_EQ(outcome.quality.at("stiffened"), 1 / 0.9);
}

TEST(UnloadQuality, TissueFarTooSoftIsDoubted) {
  expect_only_doubt(taken_off(0.3), "3.33 times as stiff as set");
}

TEST(UnloadQuality, TissueThatRestsFarFromWhereItWasImagedIsDoubted) {
  UnloadingRecord record = taken_off(1);
  record.report.round_trip_max_mm = 4.4;
  record.report.round_trip_rms_mm = 0.4;
  EXPECT_EQ(judge_unloading(record).status, Status::ok);
  record.report.round_trip_max_mm = 7.2;
  expect_only_doubt(record, "up to 7 mm from where it was imaged (0.4 mm");
}

TEST(UnloadQuality, TissueSofterThanAnEighthOfThatIsNotUnloaded) {
  for (const double share : {0.12, 0.0}) {
    const UnloadingRecord record = taken_off(share);
    EXPECT_EQ(record.stiffness_factor, 0.2);
    EXPECT_EQ(judge_unloading(record).status, Status::not_converged) << share;
  }
}

TEST(UnloadQuality, ACoilThatPressedIsSaidAndWhatCameOfIt) {
  UnloadingRecord record = taken_off(1);
  record.coil = PressedSides{CoilPlates{}, 0.45};
  record.coil->plates->left_cm2 = 36, record.coil->plates->right_cm2 = 39;
  record.coil->plates->apart_mm = 64;
  const Outcome kept = judge_unloading(record);
  EXPECT_EQ(kept.status, Status::look);
  ASSERT_EQ(kept.reasons.size(), 1u);
  EXPECT_NE(kept.reasons[0].find("0.45 times as wide as high, and 36 and 39 cm2"),
            std::string::npos)
      << kept.reasons[0];
  EXPECT_NE(kept.reasons[0].find("stays as narrow"), std::string::npos) << kept.reasons[0];
  EXPECT_EQ(kept.quality.at("coil").at("plates").at("apart_mm"), 64);
  EXPECT_TRUE(kept.quality.at("coil").at("force_N").is_null());

  record.release = CoilRelease{{}, {26, 0.8, 5, ""}};
  record.report.skin_force_N = 8;
  const Outcome let_go = judge_unloading(record);
  EXPECT_EQ(let_go.status, Status::look);
  EXPECT_NE(let_go.reasons[0].find("0.80 times as wide as high (unload.coil_roundness), for which "
                                   "plates would have pressed with 8 N"),
            std::string::npos)
      << let_go.reasons[0];
  EXPECT_EQ(let_go.quality.at("coil").at("way_mm"), 26);
}

TEST(UnloadQuality, PlacesOfABreastThatFallsFartherThanWomensAreDoubted) {
  for (const double move_mm : {160.0, 250.0}) {
    UnloadingRecord record = taken_off(1);
    PoseState& supine = record.poses["supine"];
    supine.result.report.converged = true;
    supine.move_mm = move_mm;
    const Outcome outcome = judge_unloading(record);
    EXPECT_EQ(outcome.quality.at("supine_move_max_mm"), move_mm);
    EXPECT_EQ(outcome.status, move_mm > 200 ? Status::look : Status::ok);
  }
}

}  // namespace
}  // namespace mammotwin
