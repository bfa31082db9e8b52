#include "registration/search/pose_search.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "registration/carry/point_carrier.h"
#include "registration/search/model_discrepancy.h"
#include "registration/search/search_ellipse.h"
#include "registration/search/view_disagreement.h"
#include "tests/registration/box_view.h"

namespace mammotwin {
namespace {

TEST(PoseSearch, FindsTurnAndShiftThatMadeTheOutline) {
  const BoxView box;
  ViewState truth = ViewState::Zero();
  truth[kTurn] = 0.8;
  truth[kShiftDepth] = -0.7;
  truth[kShiftLateral] = 0.6;
  const ViewMatch match = box.match(truth);
  const PoseEstimate found = search_pose({&match}, {ViewState::Zero()}, true);
  EXPECT_GT(match.figures(ViewState::Zero()).outline_rms_mm, 2);
  // The prior pulls towards 0 by what the evidence does not know.
  for (const int i : {kTurn, kShiftDepth, kShiftLateral})
    EXPECT_NEAR(found.states[0][i], truth[i], 2 * std::sqrt(found.covariances[0](i, i))) << i;
  EXPECT_LT(match.figures(found.states[0]).outline_rms_mm, 0.7);
  EXPECT_EQ(found.states[0][kThickness], 0);
}

// 48 mm, four of its standard deviations, as an edge behind the chest wall asks for. The prior's
// pull beyond two is 2, so that it moves the optimum by 2 c, c the variance left (0.0034): 0.007. A
// Gaussian's pull of 4 would move it by 0.014.
TEST(PoseSearch, FollowsAnEdgeThatStandsCentimetresOff) {
  const BoxView box;
  ViewState truth = ViewState::Zero();
  truth[kShiftDepth] = -4;
  const ViewMatch match = box.match(truth);
  const PoseEstimate found = search_pose({&match}, {ViewState::Zero()}, true);
  const double left = found.covariances[0](kShiftDepth, kShiftDepth);
  EXPECT_NEAR(found.states[0][kShiftDepth], -4 + 2 * left, 0.003);
  EXPECT_LT(left, 0.05);
}

/// An MLO's detector: the breast turned by -25 degrees, 30 mm further in; another turn, by a
/// standard deviation, brings half of one in depth.
struct ExpectedTurned : BoxView {
  ExpectedTurned() {
    EdgePrior edge;
    edge.mean[kTurn] = -25, edge.sd[kTurn] = 12;
    edge.mean[kShiftDepth] = 30, edge.sd[kShiftDepth] = 10;
    edge.mean[kShiftLateral] = -20;
    edge.shift_by_turn = {0.5, -0.25};
    view.expect(edge);
  }
  ViewState off_mean(double turn, double depth, double lateral) const {
    return view.mean() + turn * ViewState::Unit(kTurn) + depth * ViewState::Unit(kShiftDepth) +
           lateral * ViewState::Unit(kShiftLateral);
  }
};

// Half of the squares beside what evidence costs; of a shift beyond two standard deviations Huber's
// 2 |r| - 2.
TEST(PoseSearch, HoldsThePlaceOnTheDetectorAgainstWhereItIsExpected) {
  const ExpectedTurned box;
  const auto cost = [&](double turn, double depth, double lateral) {
    const ViewState z = box.off_mean(turn, depth, lateral);
    const ViewMatch match = box.match(z);
    return pose_at({&match}, {z}).cost - match.residuals(z, true).squaredNorm() / 2;
  };
  EXPECT_NEAR(cost(0, 0, 0), 0, 1e-9);
  EXPECT_NEAR(cost(1, 0.5, -0.25), 0.5, 1e-9);
  EXPECT_NEAR(cost(1, 0, -0.25), 0.5 + 0.125, 1e-9);
  EXPECT_NEAR(cost(1, 0.5, 0.75), 0.5 + 0.5, 1e-9);
  EXPECT_NEAR(cost(0, -3, 0), 4, 1e-9);
}

TEST(PoseSearch, FindsABreastThatLiesTurnedAsInAnMlo) {
  const ExpectedTurned box;
  const ViewState truth = box.off_mean(-1, -0.5, 0.25);  // by 37 degrees
  const ViewMatch match = box.match(truth);
  const PoseEstimate found = search_pose({&match}, {box.view.mean()}, true);
  for (const int i : {kTurn, kShiftDepth, kShiftLateral})
    EXPECT_NEAR(found.states[0][i], truth[i], 2 * std::sqrt(found.covariances[0](i, i))) << i;
  EXPECT_LT(match.figures(found.states[0]).outline_rms_mm, 0.7);
}

TEST(PoseSearch, FindsAMechanicalNumberAndKnowsWhatItDoesNot) {
  const BoxView box;
  ViewState truth = ViewState::Zero();
  truth[kThickness] = 1.2;
  const ViewMatch match = box.match(truth);
  const PoseEstimate found = search_pose({&match}, {ViewState::Zero()});
  EXPECT_NEAR(found.states[0][kThickness], 1.2, 0.5);
  EXPECT_LT(found.covariances[0](kThickness, kThickness), 0.5);
  EXPECT_NEAR(found.covariances[0](kTilt, kTilt), 1, 1e-6);  // has no effect here: the prior stays
  EXPECT_LT(match.figures(found.states[0]).outline_rms_mm,
            0.5 * match.figures(ViewState::Zero()).outline_rms_mm);
}

// Thickness moves a point by 5 % of its place in the view a standard deviation. A state known
// exactly that alone is 2 off leaves that; a covariance that expects it leaves nothing.
TEST(ViewDisagreement, IsWhatCovariancesDoNotExpect) {
  const BoxView box;
  const ViewMatch match = box.match(ViewState::Zero());
  KnownState together{ViewState::Zero(), {}}, alone{2 * ViewState::Unit(kThickness), {}};
  together.covariance.setZero();
  alone.covariance.setZero();
  double squared = 0;
  const HermiteMesh here(box.view.base, box.view.elements);
  for (int e = 0; e < here.num_elements(); ++e)
    squared += (0.1 * box.detector.project(here.position({e, {0.5, 0.5, 0.5}}))).squaredNorm();
  EXPECT_NEAR(view_disagreement(match, together, alone),
              std::sqrt(squared / here.num_elements() / 2), 1e-6);
  EXPECT_EQ(view_disagreement(match, together, together), 0);
  alone.covariance(kThickness, kThickness) = 4.01;
  EXPECT_EQ(view_disagreement(match, together, alone), 0);
}

// Variances 4 and 1 along axes turned by 30 degrees, of Student's law with ten degrees of freedom:
// a normal vector over the root of chi-square / 10, whose variance is 10 / 8.
TEST(SearchEllipse, HoldsTheProbabilityThatItStates) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(M_PI / 6).toRotationMatrix();
  const Eigen::Matrix2d covariance = turn * Eigen::Vector2d(4, 1).asDiagonal() * turn.transpose();
  const SearchEllipse ninety = search_ellipse(covariance, 0.9),
                      half = search_ellipse(covariance, 0.5);
  EXPECT_NEAR(ninety.major_mm, 2 * 2.16313, 1e-4);
  EXPECT_NEAR(ninety.minor_mm, 2.16313, 1e-4);
  EXPECT_NEAR(ninety.angle_deg, 30, 1e-9);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> chi_squared(10);
  int in_ninety = 0, in_half = 0;
  constexpr int draws = 4000;
  for (int n = 0; n < draws; ++n) {
    const double root = std::sqrt(chi_squared(random) / 8);
    const Eigen::Vector2d off = turn * Eigen::Vector2d(2 * normal(random), normal(random)) / root;
    in_ninety += contains(ninety, off);
    in_half += contains(half, off);
  }
  EXPECT_NEAR(in_ninety / double(draws), 0.9, 0.02);  // four standard deviations of 4000 draws
  EXPECT_NEAR(in_half / double(draws), 0.5, 0.032);
}

TEST(SearchEllipse, ItsRimPartsInsideFromOutside) {
  const SearchEllipse ellipse{8, 3, 25};
  for (const Eigen::Vector2d& off : rim(ellipse, 36)) {
    EXPECT_TRUE(contains(ellipse, 0.999 * off));
    EXPECT_FALSE(contains(ellipse, 1.001 * off));
  }
}

// Beside where patterns are compared a search's 1 mm become 6.2: by 1 - exp(-1) of the way, in
// squares, at 30 mm.
TEST(SearchEllipse, GrowsBesideTheImageThatTheSearchSaw) {
  Detector detector;
  detector.pixels = PixelGrid{0.5, 400, 600};  // 200 x 300 mm
  ViewUncertainty uncertainty;
  uncertainty.discrepancy_mm = 1;
  const auto at = [&](double u, double v) {
    return unexplained_mm2(uncertainty, detector, {u, v}) - kModelSd_mm * kModelSd_mm;
  };
  EXPECT_NEAR(at(-30, 0), 1, 1e-12) << "no search";
  uncertainty.against_mammogram = true;
  for (const auto& [u, v] : {std::pair{10., 0.}, {199., 149.}, {10., -149.}})
    EXPECT_NEAR(at(u, v), 1, 1e-12);
  const double far = kUncorrectedSd_mm * kUncorrectedSd_mm, share = 1 - std::exp(-1);
  for (const auto& [u, v] : {std::pair{-20., 20.}, {230., 0.}, {50., -180.}, {-18., 174.}})
    EXPECT_NEAR(at(u, v), 1 + share * (far - 1), 1e-9) << u << " " << v;
  uncertainty.edge.shift_mm.x() = 60;
  EXPECT_NEAR(at(40, 0), 1 + share * (far - 1), 1e-9) << "behind the plates' edge";
  EXPECT_NEAR(at(70, 0), 1, 1e-12);
  uncertainty.discrepancy_mm = 8;
  EXPECT_NEAR(at(-30, 0), 64, 1e-9) << "never less than in the image";
  detector.pixels.reset();
  EXPECT_NEAR(at(-30, 0), 64, 1e-9);
}

TEST(SearchEllipse, GrowsWithWhatIsNotKnown) {
  const BoxView box;
  CompressedView view = box.box.view;
  ViewUncertainty uncertainty;
  uncertainty.covariance.setZero();
  const MeshPoint point{0, {0.5, 0.5, 0.5}};
  const auto at = [&] {
    return detector_covariance(uncertainty, box.box.compressed, view, box.detector, point);
  };
  EXPECT_NEAR(at().trace(), 2 * kModelSd_mm * kModelSd_mm, 1e-12);
  uncertainty.covariance(kShiftLateral, kShiftLateral) = 1;
  // A shift of sd at height h moves the shadow by sd D / (D - h).
  const double height = view.frame.view_from_lps(box.box.compressed.position(point)).z();
  const double shadow = uncertainty.sd[kShiftLateral] * 660 / (660 - height);
  EXPECT_NEAR(at()(1, 1), kModelSd_mm * kModelSd_mm + shadow * shadow, 1e-9);
  EXPECT_NEAR(at()(0, 0), kModelSd_mm * kModelSd_mm, 1e-9);
  uncertainty = without_placement(uncertainty);
  EXPECT_NEAR(at().trace(), 2 * kModelSd_mm * kModelSd_mm, 1e-12);
  uncertainty.covariance(kThickness, kThickness) = 1;
  uncertainty.varied[kThickness] =
      combined(1.1, box.box.compressed.nodes(), 0, box.box.compressed.nodes());
  const double thickness = at().trace();
  EXPECT_GT(thickness, 2 * kModelSd_mm * kModelSd_mm + 0.1);
  uncertainty = without_placement(uncertainty);
  EXPECT_EQ(at().trace(), thickness);
  uncertainty.discrepancy_mm = 6;
  EXPECT_NEAR(at().trace(), thickness + 2 * 36, 1e-9);
}

}  // namespace
}  // namespace mammotwin
