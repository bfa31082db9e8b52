#include "registration/search/search_verdict.h"

#include <gtest/gtest.h>

#include "registration/search/model_discrepancy.h"
#include "registration/search/search_ellipse.h"

namespace mammotwin {
namespace {

/// What a good search leaves.
MatchFigures good() { return {1.2, 3.0, 3.0, 0.8}; }

SearchVerdict judged(const MatchFigures& left, const ViewState& state = ViewState::Zero(),
                     const EdgePrior& edge = {}) {
  return judge_search("mlo", left, state, edge, true);
}

bool says(const SearchVerdict& verdict, const std::string& part) {
  for (const std::string& reason : verdict.reasons)
    if (reason.find(part) != std::string::npos) return true;
  return false;
}

TEST(SearchVerdict, IsOkWhereNothingIsWrong) {
  EXPECT_EQ(judged(good()).end, SearchEnd::ok);
  EXPECT_TRUE(judged(good()).reasons.empty());
}

TEST(SearchVerdict, AsksToLookAtAMiddlingFit) {
  MatchFigures left = good();
  left.outline_rms_mm = 6.04;
  EXPECT_EQ(judged(left).end, SearchEnd::look);
  EXPECT_TRUE(says(judged(left), "mlo: after the search the model's outline still lies 6.0 mm"));
  left = good();
  left.nipple_mm = 12;
  EXPECT_EQ(judged(left).end, SearchEnd::look);
  left.nipple_sd_mm = 15;  // nobody knew where it was
  EXPECT_EQ(judged(left).end, SearchEnd::ok);
  EXPECT_EQ(judge_search("cc", good(), ViewState::Zero(), {}, false).end, SearchEnd::look);
}

TEST(SearchVerdict, IsNoRegistrationWithAnOutlineElsewhere) {
  MatchFigures left = good();
  left.outline_rms_mm = 9.6;
  const SearchVerdict verdict = judged(left);
  EXPECT_EQ(verdict.end, SearchEnd::no_registration);
  EXPECT_TRUE(says(verdict, "9.6 mm (RMS) off the mammogram's, more than 8 mm"));
  EXPECT_TRUE(says(verdict, "the prediction without the mammogram"));
}

TEST(SearchVerdict, AsksToLookAtAMammogramThatMayBeOfAnotherView) {
  MatchFigures left = good();
  left.view_doubt = "no pectoral edge is seen in this MLO; is it one?";
  EXPECT_EQ(judged(left).end, SearchEnd::look);
  EXPECT_TRUE(says(judged(left), "no pectoral edge is seen"));
  left.pattern_correlation = 0.7;
  EXPECT_EQ(judged(left).end, SearchEnd::no_registration);
  EXPECT_TRUE(says(judged(left), "correlate by 0.70 only"));
  left.view_doubt.clear();
  EXPECT_EQ(judged(left).end, SearchEnd::look);
  left.pattern_correlation.reset();
  left.view_doubt = "no pectoral edge is seen in this MLO; is it one?";
  EXPECT_EQ(judged(left).end, SearchEnd::look) << "nothing else speaks against it";
}

// So an MLO that hung upside down, whose pattern correlated by 0.71 all the same.
TEST(SearchVerdict, IsNoRegistrationWithASureNippleElsewhere) {
  MatchFigures left = good();
  left.nipple_mm = 45.5, left.nipple_sd_mm = 5;
  EXPECT_EQ(judged(left).end, SearchEnd::no_registration);
  EXPECT_TRUE(says(judged(left), "nipple still lies 45.5 mm off the mammogram's, more than 20 mm"));
  left.nipple_sd_mm = 12;
  EXPECT_EQ(judged(left).end, SearchEnd::look) << "it may be elsewhere";
  left.nipple_mm = 19, left.nipple_sd_mm = 3;
  EXPECT_EQ(judged(left).end, SearchEnd::look);
}

TEST(SearchVerdict, IsNoRegistrationWithAnotherPattern) {
  MatchFigures left = good();
  left.pattern_correlation = 0.07;
  EXPECT_EQ(judged(left).end, SearchEnd::no_registration);
  EXPECT_TRUE(says(judged(left), "correlate by 0.07 only, less than 0.6"));
  left.pattern_correlation = 0.61;
  EXPECT_EQ(judged(left).end, SearchEnd::look);
}

TEST(SearchVerdict, AsksToLookWhereNoPatternSaysWhoseBreastItIs) {
  MatchFigures left = good();
  left.pattern_correlation.reset();
  left.dense_detail_mm = 0.42;
  EXPECT_EQ(judged(left).end, SearchEnd::look);
  EXPECT_TRUE(says(judged(left), "next to no gland"));
  EXPECT_TRUE(says(judged(left), "varies by 0.4 mm"));
  std::vector<SearchVerdict> both{judged(left), judged(left)};
  judge_together({"cc", "mlo"}, both);
  EXPECT_EQ(both[0].end, SearchEnd::look);
  EXPECT_EQ(both[1].end, SearchEnd::look);
}

/// As good, but for a pattern that could be another breast's.
MatchFigures weak() { return {1.2, 3.0, 3.0, 0.7}; }

TEST(SearchVerdict, IsNoRegistrationWithAStateBeyondTwoDeviations) {
  ViewState state = ViewState::Zero();
  state[kRoll] = 11.9;  // of 6 degrees
  EXPECT_EQ(judged(weak(), state).end, SearchEnd::look);
  EXPECT_FALSE(says(judged(weak(), state), "another roll"));
  state[kRoll] = -12.1;
  EXPECT_EQ(judged(weak(), state).end, SearchEnd::no_registration);
  EXPECT_TRUE(says(judged(weak(), state), "another roll, by -12.1 degrees; beyond -12.0"));
  state = ViewState::Zero();
  state[kStiffnessRatio] = 1.5;  // ln; e^1.5 = 4.48, e^1.4 = 4.06
  EXPECT_TRUE(says(judged(weak(), state), "4.48 times the stiffness of gland over fat"));
  state = ViewState::Zero();
  state[kFriction] = -0.31;  // of 0.15
  EXPECT_TRUE(
      says(judged(weak(), state), "another friction with the plates, by -0.31; beyond -0.30"));
  state = ViewState::Zero();
  state[kShiftLateral] = 25;  // of 12 mm
  EXPECT_TRUE(says(judged(weak(), state), "another place sideways, by 25.0 mm; beyond 24.0"));
}

TEST(SearchVerdict, AsksToLookAtAStrangeStateOfSurelyThisBreast) {
  ViewState state = ViewState::Zero();
  state[kRoll] = 12.1;
  EXPECT_EQ(judged(good(), state).end, SearchEnd::look);
  EXPECT_TRUE(says(judged(good(), state), "mlo: the mammogram asks for another roll, by 12.1"));
  MatchFigures left = good();
  left.outline_rms_mm = 5.1;
  EXPECT_EQ(judged(left, state).end, SearchEnd::no_registration);
  left = good();
  left.pattern_correlation.reset();
  EXPECT_EQ(judged(left, state).end, SearchEnd::no_registration);
}

TEST(SearchVerdict, SaysThatTheBaselineLiesNearer) {
  const auto beside = [](double rms_mm) {
    return judge_search("cc", good(), ViewState::Zero(), {}, true, MatchFigures{rms_mm, {}, 3, {}});
  };
  EXPECT_EQ(beside(0.3).end, SearchEnd::ok);  // the model's is 1.2
  EXPECT_EQ(beside(0.1).end, SearchEnd::look);
  EXPECT_TRUE(says(beside(0.1), "lies 0.1 mm (RMS) off the mammogram's outline, nearer than"));
}

TEST(SearchVerdict, LetsADetectorStandWhereDetectorsDo) {
  EdgePrior edge;
  edge.mean[kShiftDepth] = 30, edge.sd[kShiftDepth] = 6;
  ViewState state = ViewState::Zero();
  for (const double shift : {19.0, 30.0, 41.0}) {
    state[kShiftDepth] = shift;
    EXPECT_EQ(judged(good(), state, edge).end, SearchEnd::ok) << shift;
  }
  for (const double shift : {0.0, 17.0, 43.0}) {
    state[kShiftDepth] = shift;
    EXPECT_EQ(judged(weak(), state, edge).end, SearchEnd::no_registration) << shift;
  }
}

TEST(SearchVerdict, DoubtsTheViewBesideOneWithoutARegistration) {
  const auto beside = [](SearchEnd end, bool in_place = false) {
    std::vector<SearchVerdict> verdicts{{SearchEnd::no_registration, {}}, {end, {}, in_place}};
    judge_together({"cc", "mlo"}, verdicts);
    EXPECT_TRUE(verdicts[0].reasons.empty());
    return verdicts[1];
  };
  EXPECT_EQ(beside(SearchEnd::ok).end, SearchEnd::look);
  EXPECT_TRUE(says(beside(SearchEnd::ok), "mlo: registered, but cc, searched with it, has none"));
  EXPECT_EQ(beside(SearchEnd::look).end, SearchEnd::no_registration);
  EXPECT_TRUE(says(beside(SearchEnd::look), "mlo: what is shown is the prediction without"));
  EXPECT_TRUE(beside(SearchEnd::no_registration).reasons.empty());
  EXPECT_EQ(beside(SearchEnd::look, true).end, SearchEnd::look);
  std::vector<SearchVerdict> fine{{SearchEnd::ok, {}}, {SearchEnd::look, {}}};
  judge_together({"cc", "mlo"}, fine);
  EXPECT_EQ(fine[0].end, SearchEnd::ok);
  EXPECT_EQ(fine[1].end, SearchEnd::look);
}

TEST(SearchVerdict, BelievesAStrangeStateBesideAViewThatIsSurelyInPlace) {
  ViewState rolled = ViewState::Zero();
  rolled[kRoll] = 15;
  MatchFigures fair = good(), weak = good(), poor = good();
  fair.pattern_correlation = 0.61;
  weak.pattern_correlation.reset();
  poor.outline_rms_mm = 9;
  const auto beside = [&](const MatchFigures& left, const MatchFigures& other) {
    std::vector<SearchVerdict> both{judged(other), judged(left, rolled)};
    judge_together({"cc", "mlo"}, both);
    return both[1];
  };
  EXPECT_EQ(beside(fair, good()).end, SearchEnd::look);
  EXPECT_TRUE(says(beside(fair, good()), "mlo: the mammogram asks for another roll"));
  EXPECT_TRUE(says(beside(fair, good()), "mlo: registered for cc"));
  EXPECT_FALSE(says(beside(fair, good()), "no registration"));
  EXPECT_EQ(beside(fair, fair).end, SearchEnd::no_registration);
  EXPECT_EQ(beside(weak, good()).end, SearchEnd::no_registration);
  EXPECT_EQ(beside(poor, good()).end, SearchEnd::no_registration);
  rolled[kRoll] = 19;  // more than three standard deviations
  EXPECT_EQ(beside(fair, good()).end, SearchEnd::no_registration);
}

TEST(ModelDiscrepancy, LeavesNoEllipseSmallerThanTheOutlineIsOff) {
  for (const double rms : {0.5, 1.9, 2.1, 5.0, 9.6}) {
    MatchFigures left = good();
    left.outline_rms_mm = rms;
    const double sd = model_discrepancy(left).sd_mm();
    const Eigen::Matrix2d covariance = sd * sd * Eigen::Matrix2d::Identity();
    EXPECT_GE(search_ellipse(covariance, 0.9).minor_mm, rms * (1 - 1e-12)) << rms;
    if (rms > 5) {
      EXPECT_GE(search_ellipse(covariance, 0.5).minor_mm, rms);
    }
  }
}

// A point at a plate of 60 mm moves by 30 mm sin 30 degrees.
TEST(ModelDiscrepancy, OfAnUncorrectedViewHoldsWhatEscapedSideways) {
  EXPECT_EQ(uncorrected_sd_mm({}, 60), kUncorrectedSd_mm);
  EXPECT_NEAR(uncorrected_sd_mm({-20, 30}, 60), std::sqrt(6.2 * 6.2 + 400 + 225), 1e-9);
  EXPECT_NEAR(uncorrected_sd_mm({0, 0, 45}, 60), std::sqrt(6.2 * 6.2 + 45 * 45), 1e-9);
}

// sqrt(20^2 / 2 - 3^2) = 13.8; within 3 mm each way nothing is left to explain.
TEST(ModelDiscrepancy, CountsANippleBeyondWhatIsKnownOfIt) {
  MatchFigures left = good();
  EXPECT_EQ(model_discrepancy(left).nipple_mm, 0);
  left.nipple_mm = 20;
  EXPECT_NEAR(model_discrepancy(left).nipple_mm, std::sqrt(191), 1e-12);
  left.nipple_sd_mm = 15;
  EXPECT_EQ(model_discrepancy(left).nipple_mm, 0);
  // A nipple found with 40 mm that turns out 94 mm off was looked for in the wrong place.
  left.nipple_mm = 94, left.nipple_sd_mm = 40;
  EXPECT_EQ(model_discrepancy(left).nipple_mm, 0);
}

TEST(ModelDiscrepancy, WithoutAPatternIsThatOfPublishedMethods) {
  MatchFigures left = good();
  left.pattern_correlation.reset();
  EXPECT_EQ(model_discrepancy(left).sd_mm(), kUncorrectedSd_mm);
  left.outline_rms_mm = 7;
  EXPECT_GT(model_discrepancy(left).sd_mm(), kUncorrectedSd_mm);
}

// At four fifths of the correlation in place errors are half of the pattern's length, 15 /
// sqrt(pi).
TEST(ModelDiscrepancy, GrowsAsThePatternFades) {
  MatchFigures left = good();
  left.pattern_correlation = 0.98;
  EXPECT_EQ(model_discrepancy(left).pattern_mm, 0);
  left.pattern_correlation = 0.95 / 1.25;
  EXPECT_NEAR(model_discrepancy(left).pattern_mm, 15 / std::sqrt(M_PI) / 2, 1e-9);
  left.pattern_correlation = -0.3;
  EXPECT_NEAR(model_discrepancy(left).pattern_mm, 15 / std::sqrt(M_PI) * std::sqrt(0.95 / 0.6 - 1),
              1e-9);
}

}  // namespace
}  // namespace mammotwin
