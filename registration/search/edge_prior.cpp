#include "registration/search/edge_prior.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "registration/view/wall_samples.h"

namespace mammotwin {
namespace {

constexpr double kBand_mm = 5, kReach_mm = 40;  // sideways, about the nipple
constexpr int kWallSamples = 6;                 // along a face's side: 4 mm on faces of 25 mm

constexpr double kCcEdgeSd_mm = 14.5;
constexpr double kMuscle_deg = 22, kMuscleSd_deg = 6;         // MLO
constexpr double kNippleShare = 0.90, kNippleShareSd = 0.12;  // of its distance from the muscle

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

/// Another turn leaves the nipple's depth, so that it goes with a shift of `lateral` by its angle.
void turn_about(double lateral_mm, EdgePrior& prior) {
  const double shift = lateral_mm * radians(prior.sd[kTurn]) / prior.sd[kShiftDepth];
  prior.covariance(kTurn, kShiftDepth) = prior.covariance(kShiftDepth, kTurn) = shift;
  prior.covariance(kShiftDepth, kShiftDepth) += shift * shift;
}

/// The wall turned to the muscle's slope, and so far in that the nipple is as deep as nipples are.
EdgePrior mlo_prior(const WallLine& wall, const Eigen::Vector2d& nipple) {
  EdgePrior prior;
  const double half_slope = wall.slope_deg / 2;
  const double turn = half_slope - kMuscle_deg;
  const double from_wall =
      (nipple.x() - wall.depth_mm) * std::cos(radians(wall.slope_deg));  // squarely
  const Eigen::Vector2d turned = Eigen::Rotation2Dd(radians(turn)) * nipple;
  prior.mean[kTurn] = turn;
  prior.mean[kShiftDepth] = kNippleShare * from_wall - turned.x();
  prior.sd[kTurn] = std::hypot(kMuscleSd_deg, half_slope);
  prior.sd[kShiftDepth] = depth_sd_beside(kNippleShareSd * from_wall, prior.sd);
  turn_about(turned.y(), prior);
  return prior;
}

}  // namespace

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

EdgePrior edge_prior(const MeshFile& compressed, const CompressedView& view,
                     const Eigen::Vector3d& nipple_in_lps) {
  if (!is_oblique(view.angle_deg)) return cc_prior();
  return mlo_prior(wall_line(compressed, view, nipple_in_lps),
                   view.frame.view_from_lps(nipple_in_lps).head<2>());
}

}  // namespace mammotwin
