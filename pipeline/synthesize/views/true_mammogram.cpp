#include "pipeline/synthesize/views/true_mammogram.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/synthesize/counter_random.h"
#include "registration/carry/point_carrier.h"
#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {
namespace {

constexpr double kPixel_mm = 0.25;
constexpr double kWhite = 65535;
constexpr double kMostAttenuation = 6;  // -ln(I/I0) that is shown white
constexpr double kPhotons = 2e4;        // per pixel in air
constexpr double kMarkerRadius_mm = 1.75;
constexpr double kShowsMuscle_deg = 20;

double bilinear(const DetectorImage& image, const Eigen::Vector2d& uv) {
  const Eigen::Vector2d at = (uv - image.first) / image.spacing_mm;
  const int i = static_cast<int>(std::floor(at.x())), j = static_cast<int>(std::floor(at.y()));
  if (i < 0 || j < 0 || i + 1 >= image.columns || j + 1 >= image.rows) return 0;
  const double a = at.x() - i, b = at.y() - j;
  return (1 - b) * ((1 - a) * image.at(i, j) + a * image.at(i + 1, j)) +
         b * ((1 - a) * image.at(i, j + 1) + a * image.at(i + 1, j + 1));
}

/// The picture as if plates and breast went on to the detector's edge: no tissue is thicker than
/// the plates are apart, and along each row that at the breast's rear goes on, in an oblique view
/// as muscle.
DetectorImage with_what_lies_behind(const SimulatedView& simulated, double plates_mm,
                                    bool oblique) {
  constexpr double kMuscle = 1.35;  // times the tissue at the rear
  constexpr double kRear_mm = 10;   // thinner is the rounded rear itself
  DetectorImage image = simulated.attenuation;
  for (int j = 0; j < image.rows; ++j) {
    const auto value = [&](int i) -> double& {
      return image.values[static_cast<std::size_t>(j) * image.columns + i];
    };
    int rear = 0;
    while (rear < image.columns && simulated.thickness.at(rear, j) < kRear_mm) ++rear;
    if (rear == image.columns) continue;
    for (int i = rear; i < image.columns; ++i)
      value(i) *= std::min(1.0, plates_mm / std::max(1.0, simulated.thickness.at(i, j)));
    for (int i = 0; i < rear; ++i) value(i) = (oblique ? kMuscle : 1) * value(rear);
  }
  return image;
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
  const SimulatedView simulated = simulate_view(breast.prone(), view.compressed,
                                                &breast.truth().fractions, view.view, detector);
  const Eigen::Vector2d marker = true_mark(breast, view, detector, breast.truth().nipple_in_lps);
  const DetectorImage picture =
      view.behind ? with_what_lies_behind(simulated, view.view.thickness_mm,
                                          std::abs(view.view.angle_deg) > kShowsMuscle_deg)
                  : simulated.attenuation;
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
