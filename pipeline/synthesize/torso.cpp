#include "pipeline/synthesize/torso.h"

#include <cmath>

#include "pipeline/synthesize/implicit.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double sheet_mm = 5;   // serratus and rectus where there is no pectoral
constexpr double flank_mm = 12;  // serratus and latissimus at the sides, over the sheet
constexpr double lean = 0.08;    // the sternum's top lies this much further back [mm/mm]

}  // namespace

Torso::Torso(const AnatomyOptions& o)
    : half_width_(o.chest_half_width_mm),
      half_depth_(o.chest_half_width_mm * o.chest_roundness),
      pectoral_(o.pectoral_mm),
      subcutaneous_(o.subcutaneous_mm),
      ripple_(o.seed, 11, 35),
      lung_vessels_(o.seed, 12, 9) {
  centre_y_ = half_depth_ + padding(0, 0);
}

double Torso::rib_cage(const Vector3d& x) const {
  // Distance to an ellipse to first order: k0 (k0 - 1) / k1 (Quilez, Ellipsoid SDF, 2008).
  const double narrowing = 1 - 0.12 * smooth_step(0, 160, x.z());
  const double a = half_width_ * narrowing, b = half_depth_ * narrowing;
  const double dy = x.y() - centre_y_ - lean * x.z() + half_depth_ - b;
  const double k0 = std::hypot(x.x() / a, dy / b);
  const double k1 = std::hypot(x.x() / (a * a), dy / (b * b));
  return k0 * (k0 - 1) / std::max(k1, 1e-6);
}

double Torso::flank_muscle(double x) const {
  return flank_mm * smooth_step(0.75 * half_width_, half_width_, std::abs(x));
}

double Torso::cusp_x(double z) const { return 0.70 * half_width_ + 0.2 * z; }

double Torso::muscle_thickness(double x, double z) const {
  const double u = std::abs(x), cusp = cusp_x(z);
  const double belly =
      smooth_step(8, 50, u) * (1 - smooth_step(cusp, cusp + 16, u)) * smooth_step(-95, -35, z);
  const double ripple = 1 + 0.12 * ripple_(Vector3d(x, 0, z));
  return sheet_mm + flank_muscle(x) + (pectoral_ - sheet_mm) * belly * ripple;
}

double Torso::padding(double x, double z) const {
  // Wider than the muscle's belly everywhere, so that fat always lies between muscle and skin.
  const double u = std::abs(x), cusp = cusp_x(z);
  const double belly = smooth_step(-10, 40, u) * (1 - smooth_step(cusp + 4, cusp + 36, u)) *
                       smooth_step(-110, -45, z);
  return sheet_mm + flank_muscle(x) + 1.12 * (pectoral_ - sheet_mm) * belly +
         subcutaneous_ * (1 - 0.25 * smooth_step(70, 140, u));
}

double Torso::chest_wall(const Vector3d& x) const {
  return rib_cage(x) - muscle_thickness(x.x(), x.z());
}

double Torso::skin(const Vector3d& x) const { return rib_cage(x) - padding(x.x(), x.z()); }

double Torso::wall_y(double x, double z) const {
  const double thickness = muscle_thickness(x, z);
  double front = -150, back = centre_y_;
  for (int i = 0; i < 18; ++i)  // to a thousandth of a millimetre
  {
    const double middle = (front + back) / 2;
    (rib_cage({x, middle, z}) > thickness ? front : back) = middle;
  }
  return (front + back) / 2;
}

Organ Torso::organ(const Vector3d& x) const {
  const double depth = -rib_cage(x);
  if (depth < 0) return Organ::muscle;
  if (depth < rib_mm) {
    if (std::abs(x.x()) < sternum_half_mm) return Organ::rib;
    const double along = x.z() + 0.45 * std::abs(x.x()) + 4 * ripple_(x);
    const double from_rib = along - rib_pitch_mm * std::floor(along / rib_pitch_mm + 0.5);
    const double across = from_rib / (rib_pitch_mm / 4), into = depth / (rib_mm / 2) - 1;
    return across * across + into * into < 1 ? Organ::rib : Organ::muscle;
  }
  if (in_heart(x)) return Organ::heart;
  if (in_liver(x)) return Organ::liver;
  return lung_vessels_(x) > 0.52 ? Organ::heart : Organ::lung;  // blood either way
}

bool Torso::in_heart(const Vector3d& x) const {
  const Vector3d d = x - Vector3d(22, centre_y_ - half_depth_ + 58, -18);
  const double along = (d.x() - d.z()) / std::sqrt(2.0), across = (d.x() + d.z()) / std::sqrt(2.0);
  return std::pow(along / 68, 2) + std::pow(across / 50, 2) + std::pow(d.y() / 46, 2) <
         1 + 0.15 * ripple_(x);
}

bool Torso::in_liver(const Vector3d& x) const {
  const Vector3d d = x - Vector3d(-55, centre_y_, -125);
  return std::pow(d.x() / 110, 2) + std::pow(d.y() / 95, 2) + std::pow(d.z() / 95, 2) < 1;
}

}  // namespace mammotwin
