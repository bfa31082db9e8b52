#include "pipeline/synthesize/views/true_mammogram.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/views/picture_behind.h"
#include "registration/carry/point_carrier.h"
#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {
namespace {

constexpr double kPixel_mm = 0.25;
constexpr double kWhite = 65535;
constexpr double kMostAttenuation = 6;  // -ln(I/I0) that is shown white
constexpr double kPhotons = 2e4;        // per pixel in air
constexpr double kMarkerRadius_mm = 1.75;

double bilinear(const DetectorImage& image, const Eigen::Vector2d& uv) {
  const Eigen::Vector2d at = (uv - image.first) / image.spacing_mm;
  const int i = static_cast<int>(std::floor(at.x())), j = static_cast<int>(std::floor(at.y()));
  if (i < 0 || j < 0 || i + 1 >= image.columns || j + 1 >= image.rows) return 0;
  const double a = at.x() - i, b = at.y() - j;
  return (1 - b) * ((1 - a) * image.at(i, j) + a * image.at(i + 1, j)) +
         b * ((1 - a) * image.at(i, j + 1) + a * image.at(i + 1, j + 1));
}

std::optional<MuscleEdge> muscle_edge(const TrueView& view, const Detector& detector) {
  if (!view.wall) return {};
  const auto seen = [&](const Eigen::Vector3d& in_lps) {
    return detector.project(view.view.frame.view_from_lps(in_lps));
  };
  const Eigen::Vector2d at = seen(view.wall->at(0)),
                        along = (seen(view.wall->at(1)) - at).normalized();
  return MuscleEdge{at, {along.y(), -along.x()}};
}

DetectorImage picture_of(const TrueBreast& breast, const TrueView& view, const Detector& detector) {
  const SimulatedView simulated = simulate_view(breast.prone(), view.compressed,
                                                &breast.truth().fractions, view.view, detector);
  if (!view.behind) return simulated.attenuation;
  return picture_behind(simulated, view.view.thickness_mm, muscle_edge(view, detector),
                        detector.detector_from_image({0, 0}).y());
}

std::uint16_t grey_of(double attenuation, CounterRandom& random) {
  // Poisson noise of the photons that arrive, in the logarithm.
  const double noisy =
      attenuation + std::exp(0.5 * attenuation) / std::sqrt(kPhotons) * random.normal();
  return static_cast<std::uint16_t>(std::clamp(noisy / kMostAttenuation, 0.0, 0.9) * kWhite);
}

}  // namespace

Detector synthetic_detector(Side side) {
  Detector detector;
  detector.pixels =
      PixelGrid{kPixel_mm, 960, 1200, side == Side::left ? ImageEdge::left : ImageEdge::right};
  return detector;
}

Eigen::Vector3d true_place(const TrueBreast& breast, const TrueView& view,
                           const Eigen::Vector3d& prone_in_lps) {
  const PointCarrier carrier(breast.prone(), view.compressed);
  return view.view.frame.view_from_lps(carrier.carry(prone_in_lps).in_lps);
}

Eigen::Vector2d true_mark(const TrueBreast& breast, const TrueView& view, const Detector& detector,
                          const Eigen::Vector3d& prone_in_lps) {
  return detector.image_from_detector(detector.project(true_place(breast, view, prone_in_lps)));
}

GreyPixels true_mammogram(const TrueBreast& breast, const TrueView& view, const Detector& detector,
                          std::uint64_t seed) {
  const DetectorImage picture = picture_of(breast, view, detector);
  const Eigen::Vector2d marker = true_mark(breast, view, detector, breast.truth().nipple_in_lps);
  const PixelGrid& grid = *detector.pixels;
  GreyPixels pixels{grid.columns, grid.rows, {}};
  CounterRandom random(seed, view.view.name == "cc" ? 1 : 2);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d uv = detector.detector_from_image({column, row});
      const bool metal =
          view.marker &&
          (Eigen::Vector2d(column, row) - marker).norm() * grid.spacing_mm <= kMarkerRadius_mm;
      const double attenuation = bilinear(picture, uv);
      pixels.grey.push_back(metal ? static_cast<std::uint16_t>(kWhite)
                                  : grey_of(attenuation, random));
    }
  return pixels;
}

}  // namespace mammotwin
