#include "registration/search/edge_prior.h"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "registration/view/breast_middle.h"
#include "registration/view/laid_on_detector.h"
#include "registration/view/wall_samples.h"

namespace mammotwin {
namespace {

constexpr double kBand_mm = 5, kReach_mm = 40;  // sideways, about the nipple
constexpr int kWallSamples = 6;                 // along a face's side: 4 mm on faces of 25 mm

constexpr double kCcEdgeSd_mm = 14.5;
// MLO
constexpr double kTurn_deg = -25, kTurnSd_deg = 12;
constexpr double kNippleShare = 0.90, kNippleShareSd = 0.12;  // of its distance from the muscle
constexpr double kDistanceSd_mm = 10;                         // of the model's own such distance

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Depth of the wall's front by band of lateral places from the nipple's.
std::map<int, double> wall_front(const MeshFile& compressed, const ViewFrame& frame,
                                 double nipple_lateral) {
  std::map<int, double> front;
  const auto see = [&](const Eigen::Vector3d& x) {
    const double aside = x.y() - nipple_lateral;
    if (std::abs(aside) > kReach_mm) return;
    const auto [band, fresh] =
        front.emplace(static_cast<int>(std::lround(aside / kBand_mm)), x.x());
    if (!fresh) band->second = std::max(band->second, x.x());
  };
  for (const WallSample& sample : wall_samples(compressed, kWallSamples))
    see(frame.view_from_lps(compressed.mesh.position(sample.at)));
  return front;
}

double depth_sd_beside(double total, const ViewState& sd) {
  return std::sqrt(std::max(0.0, total * total - sd[kClearance] * sd[kClearance]));
}

EdgePrior cc_prior() {
  EdgePrior prior;
  prior.sd[kShiftDepth] = depth_sd_beside(kCcEdgeSd_mm, prior.sd);
  return prior;
}

EdgePrior mlo_prior(const MeshFile& compressed, const CompressedView& view,
                    const Eigen::Vector3d& nipple_in_lps) {
  const double from_wall = wall_line(compressed, view, nipple_in_lps)
                               .to_nipple_mm(view.frame.view_from_lps(nipple_in_lps).head<2>());
  const auto shift = [&](double turn_deg) {
    return shift_of_turned(turn_deg, compressed.mesh, view, nipple_in_lps,
                           kNippleShare * from_wall);
  };
  EdgePrior prior;
  prior.mean[kTurn] = kTurn_deg;
  prior.mean.segment<2>(kShiftDepth) = shift(kTurn_deg);
  prior.sd[kTurn] = kTurnSd_deg;
  prior.sd[kShiftDepth] =
      depth_sd_beside(std::hypot(kNippleShareSd * from_wall, kDistanceSd_mm), prior.sd);
  prior.shift_by_turn = (shift(kTurn_deg + kTurnSd_deg) - shift(kTurn_deg - kTurnSd_deg)).array() /
                        2 / prior.sd.segment<2>(kShiftDepth).array();
  return prior;
}

}  // namespace

ViewState EdgePrior::deviations(const ViewState& state) const {
  ViewState off = (state - mean).cwiseQuotient(sd);
  off.segment<2>(kShiftDepth) -= off[kTurn] * shift_by_turn;
  return off;
}

Eigen::Matrix<double, kStates, kStates> EdgePrior::covariance() const {
  Eigen::Matrix<double, kStates, kStates> root =
      Eigen::Matrix<double, kStates, kStates>::Identity();
  root.block<2, 1>(kShiftDepth, kTurn) = shift_by_turn;
  return root * root.transpose();
}

double WallLine::depth_at(double aside_mm) const {
  return depth_mm + std::tan(radians(slope_deg)) * aside_mm;
}

double WallLine::to_nipple_mm(const Eigen::Vector2d& nipple) const {
  return (nipple.x() - depth_mm) * std::cos(radians(slope_deg));
}

WallLine wall_line(const MeshFile& compressed, const CompressedView& view,
                   const Eigen::Vector3d& nipple_in_lps) {
  const double lateral = view.frame.view_from_lps(nipple_in_lps).y();
  const std::map<int, double> front = wall_front(compressed, view.frame, lateral);
  if (front.size() < 2)
    throw std::invalid_argument(view.name + ": no chest wall within 40 mm of the nipple sideways");
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const auto& [band, depth] : front) {
    const Eigen::Vector2d row(1, band * kBand_mm);
    normal += row * row.transpose();
    right += row * depth;
  }
  const Eigen::Vector2d line = normal.inverse() * right;
  return {line[0], std::atan(line[1]) * 180 / std::numbers::pi};
}

Eigen::Vector2d shift_of_turned(double turn_deg, const HermiteMesh& pressed,
                                const CompressedView& view, const Eigen::Vector3d& nipple_in_lps,
                                double nipple_depth_mm) {
  const CompressedView turned = laid_on_detector(view, turn_deg, {0, 0});
  const double depth = nipple_depth_mm - turned.frame.view_from_lps(nipple_in_lps).x();
  return {depth, -breast_middle_mm(pressed, laid_on_detector(turned, 0, {depth, 0}).frame)};
}

EdgePrior edge_prior(const MeshFile& compressed, const CompressedView& view,
                     const Eigen::Vector3d& nipple_in_lps) {
  if (!is_oblique(view.angle_deg)) return cc_prior();
  return mlo_prior(compressed, view, nipple_in_lps);
}

}  // namespace mammotwin
