#include "pipeline/synthesize/views/true_tomosynthesis.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/views/true_mammogram.h"

namespace mammotwin {
namespace {

constexpr double kSource_mm = 660, kArc_deg = 15;
constexpr int kProjections = 15;
constexpr double kScanPixel_mm = 0.4, kSlice_mm = 1;
constexpr double kScanQuanta = 2e4;  // per pixel in air, over all projections of a pixel of 0.25 mm
constexpr double kBallRadius_mm = 1.75, kMetal = 1;  // [1/mm]

std::vector<Eigen::Vector3d> tube_places() {
  std::vector<Eigen::Vector3d> all;
  for (int n = 0; n < kProjections; ++n) {
    const double angle = kArc_deg * (double(n) / (kProjections - 1) - 0.5) * std::numbers::pi / 180;
    all.emplace_back(0, kSource_mm * std::sin(angle), kSource_mm * std::cos(angle));
  }
  return all;
}

/// 160 by 240 mm, over the edge's middle: what the largest of these breasts takes.
DetectorImage scan_field() {
  DetectorImage image;
  image.spacing_mm = kScanPixel_mm;
  image.columns = 400;
  image.rows = 600;
  image.first = {kScanPixel_mm / 2, -(image.rows - 1) * kScanPixel_mm / 2};
  image.values.assign(static_cast<std::size_t>(image.columns) * image.rows, 0);
  return image;
}

void add_marker(const Eigen::Vector3d& centre, const Eigen::Vector3d& source,
                DetectorImage& projection) {
  for (int j = 0; j < projection.rows; ++j)
    for (int i = 0; i < projection.columns; ++i) {
      const Eigen::Vector2d uv = projection.first + kScanPixel_mm * Eigen::Vector2d(i, j);
      const Eigen::Vector3d foot(uv.x(), uv.y(), 0), way = (source - foot).normalized();
      const double off = (centre - foot).cross(way).norm();
      if (off < kBallRadius_mm)
        projection.values[static_cast<std::size_t>(j) * projection.columns + i] +=
            2 * kMetal * std::sqrt(kBallRadius_mm * kBallRadius_mm - off * off);
    }
}

void add_quanta(DetectorImage& projection, std::uint64_t seed, int n) {
  constexpr double kPlain_mm = 0.25;
  const double photons = kScanQuanta * std::pow(kScanPixel_mm / kPlain_mm, 2) / kProjections;
  CounterRandom random(seed, 100 + n);
  for (double& a : projection.values) a += std::exp(a / 2) / std::sqrt(photons) * random.normal();
}

double value_at(const DetectorImage& image, const Eigen::Vector2d& uv) {
  const Eigen::Vector2d at = (uv - image.first) / image.spacing_mm;
  const int i = std::clamp(static_cast<int>(std::floor(at.x())), 0, image.columns - 2);
  const int j = std::clamp(static_cast<int>(std::floor(at.y())), 0, image.rows - 2);
  const double a = std::clamp(at.x() - i, 0., 1.), b = std::clamp(at.y() - j, 0., 1.);
  return (1 - b) * ((1 - a) * image.at(i, j) + a * image.at(i + 1, j)) +
         b * ((1 - a) * image.at(i, j + 1) + a * image.at(i + 1, j + 1));
}

/// What lies in the slice adds up where projections are shifted so that it does; the rest blurs.
DetectorImage shifted_and_added(const std::vector<DetectorImage>& projections, double height) {
  const std::vector<Eigen::Vector3d> from = tube_places();
  DetectorImage slice = projections.front();
  tbb::parallel_for(0, slice.rows, [&](int j) {
    for (int i = 0; i < slice.columns; ++i) {
      const Eigen::Vector2d xy = slice.first + kScanPixel_mm * Eigen::Vector2d(i, j);
      double sum = 0;
      for (std::size_t n = 0; n < projections.size(); ++n) {
        const Eigen::Vector2d source = from[n].head<2>();
        const double stretch = from[n].z() / (from[n].z() - height);
        sum += value_at(projections[n], source + (xy - source) * stretch);
      }
      slice.values[static_cast<std::size_t>(j) * slice.columns + i] = sum / projections.size();
    }
  });
  return slice;
}

}  // namespace

TomosynthesisVolume tomosynthesis_volume(const HermiteMesh& prone, const HermiteMesh& compressed,
                                         const Volume<Fractions>* fractions,
                                         const CompressedView& view,
                                         const std::optional<Eigen::Vector3d>& marker_in_view,
                                         std::uint64_t seed) {
  const std::vector<Eigen::Vector3d> from = tube_places();
  std::vector<DetectorImage> projections =
      simulate_projections(prone, compressed, fractions, view, from, scan_field());
  for (int n = 0; n < kProjections; ++n) {
    if (marker_in_view) add_marker(*marker_in_view, from[n], projections[n]);
    add_quanta(projections[n], seed, n);
  }
  TomosynthesisVolume volume;
  volume.pixel_mm = kScanPixel_mm;
  volume.stack.spacing_mm = kSlice_mm;
  volume.stack.lowest_mm = kSlice_mm / 2;
  volume.stack.count = static_cast<int>(std::ceil(view.thickness_mm / kSlice_mm)) + 2;
  for (int n = 1; n <= volume.stack.count; ++n)
    volume.slices.push_back(shifted_and_added(projections, volume.stack.height_of(n)));
  return volume;
}

TomosynthesisVolume true_tomosynthesis(const TrueBreast& breast, const TrueView& view,
                                       std::uint64_t seed) {
  return tomosynthesis_volume(breast.prone(), view.compressed, &breast.truth().fractions, view.view,
                              true_place(breast, view, breast.truth().nipple_in_lps), seed);
}

Detector detector_of(const TomosynthesisVolume& volume, Side side) {
  const DetectorImage& image = volume.slices.front();
  Detector detector;
  detector.source_distance_mm = kParallel_mm;
  detector.pixels = PixelGrid{volume.pixel_mm, image.columns, image.rows,
                              side == Side::left ? ImageEdge::left : ImageEdge::right};
  detector.slices = volume.stack;
  return detector;
}

}  // namespace mammotwin
