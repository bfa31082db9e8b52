#include "pipeline/synthesize/lesion_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "pipeline/synthesize/counter_random.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double clearance_mm = 6;
// From the base to the tip: what lies further back hides behind the detector's edge in CC.
constexpr double rearmost_share = 0.45;
constexpr int attempts = 20000;

Eigen::Matrix3d random_rotation(CounterRandom& random) {
  Eigen::Matrix3d R;
  R.col(0) = random.direction();
  R.col(1) = R.col(0).cross(random.direction()).normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

bool has_room(const Chest& chest, const Vector3d& x, double radius,
              const std::vector<LesionShape>& others) {
  const double room = radius + clearance_mm;
  if (chest.outside(x) > -room || chest.chest_wall(x) < room) return false;
  return std::all_of(others.begin(), others.end(), [&](const LesionShape& other) {
    return (x - other.centre()).norm() > room + other.reach();
  });
}

}  // namespace

LesionShape::LesionShape(const Vector3d& centre, double diameter_mm, std::uint64_t seed, int number)
    : centre_(centre), lobules_(seed, 61 + number, 0.8) {
  CounterRandom random(seed, 71 + number);
  Vector3d axes(random.uniform(0.8, 1.25), random.uniform(0.8, 1.25), 1);
  axes *= diameter_mm / 2 / std::cbrt(axes.prod());
  lobulation_ = random.uniform(0.05, 0.22);
  reach_ = axes.maxCoeff() * (1 + lobulation_);
  const Eigen::Matrix3d R = random_rotation(random);
  unit_from_offset_ = axes.cwiseInverse().asDiagonal() * R.transpose();
}

bool LesionShape::contains(const Vector3d& x) const {
  const Vector3d offset = x - centre_;
  if (offset.squaredNorm() > reach_ * reach_) return false;
  const double r = (unit_from_offset_ * offset).norm();
  if (r < 1 - lobulation_) return true;
  return r <
         1 + lobulation_ * std::clamp(lobules_(offset / std::max(offset.norm(), 1e-9)), -1.0, 1.0);
}

std::vector<LesionShape> place_lesions(const Chest& chest, const AnatomyOptions& o) {
  const BreastShape& b = chest.breast(o.side);
  CounterRandom random(o.seed, 60);
  std::vector<LesionShape> lesions;
  for (int n = 0; n < attempts && static_cast<int>(lesions.size()) < o.lesions; ++n) {
    const double share = (static_cast<double>(lesions.size()) + random.uniform()) / o.lesions;
    const double diameter = o.lesion_min_mm + share * (o.lesion_max_mm - o.lesion_min_mm);
    const Vector3d x =
        b.axis(random.uniform(rearmost_share, 0.9)) +
        Vector3d(random.uniform(-0.7, 0.7) * b.width, 0, random.uniform(-0.7, 0.7) * b.height);
    const LesionShape candidate(x, diameter, o.seed, static_cast<int>(lesions.size()));
    if (has_room(chest, x, candidate.reach(), lesions)) lesions.push_back(candidate);
  }
  if (static_cast<int>(lesions.size()) < o.lesions) {
    std::ostringstream message;
    message << "synthetic patient: lesions is " << o.lesions << " of up to " << o.lesion_max_mm
            << " mm, but a breast of " << o.volume_ml << " ml has room for " << lesions.size()
            << "; ask for fewer or smaller ones";
    throw std::invalid_argument(message.str());
  }
  return lesions;
}

}  // namespace mammotwin
