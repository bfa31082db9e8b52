#include "registration/simulated_mammogram.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mammotwin {
namespace {

/// Grid of the compressed breast in view coordinates [mm]; tissue varies over the MRI's millimetre.
constexpr double kVoxel_mm = 1;

using Values = Volume<double>;

/// `value` of the tissue at each voxel of the compressed breast, 0 outside it; 0 behind the edge
/// too, where no ray to the detector passes.
Values compressed_volume(const HermiteMesh& prone, const HermiteMesh& compressed,
                         const ViewFrame& frame,
                         const std::function<double(const Eigen::Vector3d&)>& value) {
  const HermiteMesh here = in_view_frame(compressed, frame);
  Eigen::AlignedBox3d box = bounding_box(here);
  box.min().x() = std::max(box.min().x(), 0.0);
  PositionGrid positions = cover(box, kVoxel_mm);
  fill_positions(here, prone, positions);
  Values values = positions.like<double>(0);
  for (std::size_t i = 0; i < values.values.size(); ++i)
    if (positions.values[i].allFinite()) values.values[i] = value(positions.values[i]);
  return values;
}

/// Bilinear in one layer; 0 beyond the grid.
double in_layer(const Values& v, int k, double i, double j) {
  const int i0 = static_cast<int>(std::floor(i)), j0 = static_cast<int>(std::floor(j));
  const double a = i - i0, b = j - j0;
  const auto at = [&](int m, int n) { return v.contains(m, n, k) ? v(m, n, k) : 0.0; };
  return (1 - b) * ((1 - a) * at(i0, j0) + a * at(i0 + 1, j0)) +
         b * ((1 - a) * at(i0, j0 + 1) + a * at(i0 + 1, j0 + 1));
}

/// Midpoint rule over the grid's layers, whose voxels are thin against the source's distance.
double along_ray(const Values& v, const Detector& detector, const Eigen::Vector2d& uv) {
  const Eigen::Vector3d source = detector.source_in_view();
  const Eigen::Vector3d foot = detector.point_on_ray(uv, -detector.support_gap_mm);
  const double obliquity = (source - foot).norm() / detector.source_distance_mm;
  double sum = 0;
  for (int k = 0; k < v.size.z(); ++k) {
    const Eigen::Vector3d index = v.index(detector.point_on_ray(uv, v.position(0, 0, k).z()));
    sum += in_layer(v, k, index.x(), index.y());
  }
  return sum * v.spacing.z() * obliquity;
}

/// Detector pixels that rays through the box can reach.
DetectorImage empty_image(const Values& v, const Detector& detector, double spacing_mm) {
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

DetectorImage project(const Values& v, const Detector& detector, double spacing_mm) {
  DetectorImage image = empty_image(v, detector, spacing_mm);
  tbb::parallel_for(0, image.rows, [&](int j) {
    for (int i = 0; i < image.columns; ++i)
      image.values[static_cast<std::size_t>(j) * image.columns + i] =
          along_ray(v, detector, image.first + spacing_mm * Eigen::Vector2d(i, j));
  });
  return image;
}

Fractions nearest(const Volume<Fractions>& fractions, const Eigen::Vector3d& x) {
  const Eigen::Vector3i v = fractions.index(x).array().round().cast<int>();
  return fractions.contains(v.x(), v.y(), v.z()) ? fractions(v.x(), v.y(), v.z()) : Fractions{};
}

}  // namespace

DetectorImage simulated_mammogram(const HermiteMesh& prone, const HermiteMesh& compressed,
                                  const Volume<Fractions>& fractions, const CompressedView& view,
                                  const Detector& detector, double spacing_mm,
                                  const Attenuation& mu) {
  const auto attenuation = [&](const Eigen::Vector3d& x_prone) {
    const Fractions f = nearest(fractions, x_prone);
    const double rest = std::max(0.0, 1.0 - f.fat - f.fibroglandular - f.lesion);  // skin's voxels
    return mu.fat * (f.fat + rest) + mu.fibroglandular * f.fibroglandular + mu.lesion * f.lesion;
  };
  return project(compressed_volume(prone, compressed, view.frame, attenuation), detector,
                 spacing_mm);
}

DetectorImage breast_along_rays(const HermiteMesh& compressed, const CompressedView& view,
                                const Detector& detector, double spacing_mm) {
  const auto one = [](const Eigen::Vector3d&) { return 1.0; };
  return project(compressed_volume(compressed, compressed, view.frame, one), detector, spacing_mm);
}

DetectorImage as_shown(const DetectorImage& attenuation, const DetectorImage& thickness,
                       const Attenuation& mu) {
  DetectorImage shown = attenuation;
  for (std::size_t i = 0; i < shown.values.size(); ++i) {
    const double t = thickness.values[i];
    if (t <= 0) continue;
    // 0: fat only, 1: fibroglandular only along the ray
    const double dense = (attenuation.values[i] / t - mu.fat) / (mu.fibroglandular - mu.fat);
    constexpr double kFatGrey = 0.22, kDenseGrey = 0.9, kRim_mm = 4;
    const double rim = std::min(1.0, t / kRim_mm);
    shown.values[i] = rim * std::clamp(kFatGrey + (kDenseGrey - kFatGrey) * dense, 0.0, 1.0);
  }
  return shown;
}

}  // namespace mammotwin
