#include "pipeline/synthesize/breast_shape.h"

#include <algorithm>
#include <cmath>

#include "pipeline/synthesize/implicit.h"

namespace mammotwin {

using Eigen::Vector3d;

Vector3d BreastShape::axis(double t) const {
  const double drift = t > 0 ? t * t : 0;
  return {base.x() + outward * turn * drift, base.y() - length * t, base.z() - sag * drift};
}

double BreastShape::distance(const Vector3d& x) const {
  const double t = std::clamp(depth_fraction(x), 0.0, 1.5);
  const Vector3d d = x - axis(t);
  // The upper half leans outward, towards the axilla: the breast's tail.
  const double above = (d.z() + std::hypot(d.z(), 20.0)) / 2;
  const double dx = d.x() - outward * 0.10 * (above - 10);
  const double waist = 1 - neck * (1 - smooth_step(0, 0.45, t));
  const double hx = width * waist, hz = height * waist * (d.z() > 0 ? 1.10 : 0.92);

  // F = 1 on the outline, h = sqrt(F) - 1, distance = h / |grad h|.
  const double F = dx * dx / (hx * hx) + d.z() * d.z() / (hz * hz) + std::pow(t, roundness);
  const Vector3d grad(2 * dx / (hx * hx), -roundness * std::pow(t, roundness - 1) / length,
                      2 * d.z() / (hz * hz));
  const double k = std::sqrt(F);
  const double deepest = -std::min(width, height);
  return std::max((k - 1) * 2 * k / std::max(grad.norm(), 1e-6), deepest);
}

double Nipple::distance(const Vector3d& x) const {
  const double sunk = 5;  // the peg starts this far under the skin [mm]
  const double top = height - radius;
  const double along = std::clamp((x - root).dot(direction), -sunk, std::max(top, -sunk));
  return (x - root - along * direction).norm() - radius;
}

}  // namespace mammotwin
