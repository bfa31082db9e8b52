#include "registration/prediction/simulated_mammogram.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

/// Grid of the compressed breast in view coordinates [mm]; tissue varies over the MRI's millimetre.
constexpr double kVoxel_mm = 1;

/// 1 and the attenuation [1/mm] inside the breast, 0 outside.
struct Voxel {
  double inside = 0, attenuation = 0;
};
using Voxels = Volume<Voxel>;

Fractions nearest(const Volume<Fractions>& fractions, const Eigen::Vector3d& x) {
  const Eigen::Vector3i v = fractions.index(x).array().round().cast<int>();
  return fractions.contains(v.x(), v.y(), v.z()) ? fractions(v.x(), v.y(), v.z()) : Fractions{};
}

/// What no fraction claims, as skin's rim, counts as fat.
double attenuation_of(const Fractions& f, const Attenuation& mu) {
  const double fat = 1.0 - f.fibroglandular - f.lesion;
  return mu.fat * fat + mu.fibroglandular * f.fibroglandular + mu.lesion * f.lesion;
}

/// The compressed breast in view coordinates, in front of the edge: no ray passes behind it.
Voxels compressed_volume(const HermiteMesh& prone, const HermiteMesh& compressed,
                         const Volume<Fractions>* fractions, const ViewFrame& frame,
                         const Attenuation& mu) {
  const HermiteMesh here = in_view_frame(compressed, frame);
  Eigen::AlignedBox3d box = bounding_box(here);
  box.min().x() = std::max(box.min().x(), 0.0);
  PositionGrid positions = cover(box, kVoxel_mm);
  fill_positions(here, prone, positions);
  Voxels voxels = positions.like<Voxel>();
  for (std::size_t i = 0; i < voxels.values.size(); ++i)
    if (const Eigen::Vector3d& x = positions.values[i]; x.allFinite())
      voxels.values[i] = {1, attenuation_of(fractions ? nearest(*fractions, x) : Fractions{}, mu)};
  return voxels;
}

/// Bilinear in one layer; 0 beyond the grid.
Voxel in_layer(const Voxels& v, int k, double i, double j) {
  const int i0 = static_cast<int>(std::floor(i)), j0 = static_cast<int>(std::floor(j));
  const double a = i - i0, b = j - j0;
  Voxel sum;
  const auto add = [&](int m, int n, double weight) {
    if (!v.contains(m, n, k)) return;
    sum.inside += weight * v(m, n, k).inside;
    sum.attenuation += weight * v(m, n, k).attenuation;
  };
  add(i0, j0, (1 - a) * (1 - b));
  add(i0 + 1, j0, a * (1 - b));
  add(i0, j0 + 1, (1 - a) * b);
  add(i0 + 1, j0 + 1, a * b);
  return sum;
}

/// Midpoint rule over the grid's layers, whose voxels are thin against the source's distance.
/// `at`: the ray's point at a height; `stretch`: its length over its height.
template <class PointAt>
Voxel along_ray(const Voxels& v, double stretch, const PointAt& at) {
  const double step_mm = v.spacing.z() * stretch;
  Voxel sum;
  for (int k = 0; k < v.size.z(); ++k) {
    const Eigen::Vector3d index = v.index(at(v.position(0, 0, k).z()));
    const Voxel layer = in_layer(v, k, index.x(), index.y());
    sum.inside += step_mm * layer.inside;
    sum.attenuation += step_mm * layer.attenuation;
  }
  return sum;
}

Voxel along_ray(const Voxels& v, const Detector& detector, const Eigen::Vector2d& uv) {
  const Eigen::Vector3d source = detector.source_in_view();
  const Eigen::Vector3d foot = detector.point_on_ray(uv, -detector.support_gap_mm);
  return along_ray(v, (source - foot).norm() / detector.source_distance_mm,
                   [&](double height) { return detector.point_on_ray(uv, height); });
}

/// Detector pixels that rays through the box can reach.
DetectorImage empty_image(const Voxels& v, const Detector& detector, double spacing_mm) {
  const Eigen::Vector3d last = v.position(v.size.x() - 1, v.size.y() - 1, v.size.z() - 1);
  Eigen::Vector2d low(0, 0), high(0, 0);
  for (const double height : {v.origin.z(), last.z()})
    for (const double lateral : {v.origin.y(), last.y()}) {
      const Eigen::Vector2d uv = detector.project({last.x(), lateral, height});
      low = low.cwiseMin(uv);
      high = high.cwiseMax(uv);
    }
  DetectorImage image;
  image.spacing_mm = spacing_mm;
  image.first = low + Eigen::Vector2d::Constant(spacing_mm / 2);
  image.columns = static_cast<int>(std::ceil((high.x() - low.x()) / spacing_mm));
  image.rows = static_cast<int>(std::ceil((high.y() - low.y()) / spacing_mm));
  image.values.assign(static_cast<std::size_t>(image.columns) * image.rows, 0);
  return image;
}

}  // namespace

SimulatedView simulate_view(const HermiteMesh& prone, const HermiteMesh& compressed,
                            const Volume<Fractions>* fractions, const CompressedView& view,
                            const Detector& detector, double spacing_mm, const Attenuation& mu) {
  const Voxels voxels = compressed_volume(prone, compressed, fractions, view.frame, mu);
  const DetectorImage empty = empty_image(voxels, detector, spacing_mm);
  SimulatedView result{empty, empty};
  tbb::parallel_for(0, empty.rows, [&](int j) {
    for (int i = 0; i < empty.columns; ++i) {
      const Voxel sum =
          along_ray(voxels, detector, empty.first + spacing_mm * Eigen::Vector2d(i, j));
      const std::size_t pixel = static_cast<std::size_t>(j) * empty.columns + i;
      result.thickness.values[pixel] = sum.inside;
      result.attenuation.values[pixel] = sum.attenuation;
    }
  });
  return result;
}

std::vector<DetectorImage> simulate_projections(const HermiteMesh& prone,
                                                const HermiteMesh& compressed,
                                                const Volume<Fractions>* fractions,
                                                const CompressedView& view,
                                                const std::vector<Eigen::Vector3d>& sources,
                                                const DetectorImage& frame, const Attenuation& mu) {
  const Voxels voxels = compressed_volume(prone, compressed, fractions, view.frame, mu);
  std::vector<DetectorImage> projections(sources.size(), frame);
  for (std::size_t n = 0; n < sources.size(); ++n)
    tbb::parallel_for(0, frame.rows, [&](int j) {
      for (int i = 0; i < frame.columns; ++i) {
        const Eigen::Vector2d uv = frame.first + frame.spacing_mm * Eigen::Vector2d(i, j);
        const Eigen::Vector3d foot(uv.x(), uv.y(), 0), up = (sources[n] - foot) / sources[n].z();
        projections[n].values[static_cast<std::size_t>(j) * frame.columns + i] =
            along_ray(voxels, up.norm(), [&](double height) -> Eigen::Vector3d {
              return foot + height * up;
            }).attenuation;
      }
    });
  return projections;
}

DetectorImage as_shown(const SimulatedView& view, const Attenuation& mu) {
  constexpr double kFatGrey = 0.22, kDenseGrey = 0.9, kRim_mm = 4;
  DetectorImage shown = view.thickness;
  for (std::size_t i = 0; i < shown.values.size(); ++i) {
    const double t = view.thickness.values[i];
    if (t <= 0) continue;
    // 0: only fat, 1: only fibroglandular tissue along the ray
    const double dense = (view.attenuation.values[i] / t - mu.fat) / (mu.fibroglandular - mu.fat);
    shown.values[i] = std::min(1.0, t / kRim_mm) *
                      std::clamp(kFatGrey + (kDenseGrey - kFatGrey) * dense, 0.0, 1.0);
  }
  return shown;
}

}  // namespace mammotwin
