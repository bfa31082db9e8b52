#include "registration/prediction/affine_baseline.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace mammotwin {
namespace {

/// Samples a side of an element: 20 mm elements are seen every 2.5 mm.
constexpr int kSamples = 8;

template <class Visit>
void for_each_sample(const HermiteMesh& mesh, const Visit& visit) {
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int k = 0; k <= kSamples; ++k)
      for (int j = 0; j <= kSamples; ++j)
        for (int i = 0; i <= kSamples; ++i)
          visit(MeshPoint{e, Eigen::Vector3d(i, j, k) / kSamples});
}

/// Lateral coordinate of the volume's centroid, by the trapezoidal rule on the samples.
double lateral_centroid(const HermiteMesh& mesh, const ViewFrame& frame) {
  const auto weight = [](double xi) { return xi == 0 || xi == 1 ? 0.5 : 1.0; };
  double volume = 0, moment = 0;
  for_each_sample(mesh, [&](const MeshPoint& p) {
    const double dv =
        weight(p.xi.x()) * weight(p.xi.y()) * weight(p.xi.z()) * mesh.jacobian(p).determinant();
    volume += dv;
    moment += dv * frame.view_from_lps(mesh.position(p)).y();
  });
  return moment / volume;
}

}  // namespace

AffineBaseline::AffineBaseline(const HermiteMesh& prone, const CompressedView& view)
    : frame_(view.frame), thickness_mm_(view.thickness_mm) {
  double high = -std::numeric_limits<double>::infinity();
  low_ = -high;
  for_each_sample(prone, [&](const MeshPoint& p) {
    const Eigen::Vector3d x = frame_.view_from_lps(prone.position(p));
    if (x.x() <= 0) return;
    low_ = std::min(low_, x.z());
    high = std::max(high, x.z());
  });
  if (!(high > low_))
    throw std::invalid_argument("baseline of view " + view.name +
                                ": no part of the prone breast lies in front of the detector's "
                                "chest-wall edge; check the view's origin");
  prone_extent_mm_ = high - low_;
  stretch_ = std::sqrt(prone_extent_mm_ / view.thickness_mm);
  lateral_centroid_ = lateral_centroid(prone, frame_);
}

void AffineBaseline::place(double turn_deg, const Eigen::Vector2d& shift_mm) {
  turn_deg_ = turn_deg;
  turn_ = Eigen::Rotation2Dd(turn_deg * std::numbers::pi / 180).toRotationMatrix();
  shift_ = shift_mm;
}

Eigen::Vector3d AffineBaseline::view_from_prone(const Eigen::Vector3d& x_in_lps) const {
  const Eigen::Vector3d x = frame_.view_from_lps(x_in_lps);
  const Eigen::Vector2d flat(stretch_ * x.x(),
                             lateral_centroid_ + stretch_ * (x.y() - lateral_centroid_));
  const Eigen::Vector2d there = turn_ * flat + shift_;
  return {there.x(), there.y(), (x.z() - low_) / (stretch_ * stretch_)};
}

Eigen::Vector3d AffineBaseline::prone_from_view(const Eigen::Vector3d& x) const {
  const Eigen::Vector2d flat = turn_.transpose() * (x.head<2>() - shift_);
  return frame_.lps_from_view({flat.x() / stretch_,
                               lateral_centroid_ + (flat.y() - lateral_centroid_) / stretch_,
                               low_ + x.z() * stretch_ * stretch_});
}

}  // namespace mammotwin
