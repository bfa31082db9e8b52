#include "pipeline/report/figures/fit_error.h"

#include <algorithm>

#include "pipeline/report/drawing/mesh_field.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/drawing/surface_render.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

constexpr const char* kField = "skin_distance_mm";
constexpr double kWidth = 300, kHeight = 280;  // [pt] a view
constexpr double kPixelsPerPoint = 2;
constexpr int kSamples = 12;             // squares a side of an element's face
constexpr int kMeasured = kSamples / 3;  // the field was measured at xi = 0, 1/3, 2/3, 1
constexpr double kLegend = 40;           // [pt] below

struct Eye {
  const char* name;
  double turn, rise;  // [rad]
};
constexpr Eye kEyes[] = {{"From the front and the side", 0.7, 0.35},
                         {"From the middle and below", -0.7, -0.5}};

Picture seen(const FaceTriangles& skin, const std::vector<double>& errors,
             const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox2d window;
  for (const Eigen::Vector3d& x : skin.points) window.extend((axes * x).head<2>().eval());
  const int width = static_cast<int>(kWidth * kPixelsPerPoint);
  const int height = static_cast<int>(kHeight * kPixelsPerPoint);
  const double pixel_mm = 1.08 * std::max(window.sizes().x() / width, window.sizes().y() / height);
  DepthImage image(width, height, window.center() - 0.5 * pixel_mm * Eigen::Vector2d(width, height),
                   pixel_mm);
  const auto colour = [&](std::size_t i) {
    const auto& [a, b, c] = skin.triangles[i];
    return fit_error_colour((errors[a] + errors[b] + errors[c]) / 3);
  };
  draw_surface(image, skin, axes, false, colour);
  draw_surface(image, skin, axes, true, colour);
  Picture picture(kWidth, kHeight);
  picture.image(image.raster(), 0, 0, kWidth, kHeight);
  return picture;
}

void draw_legend(Picture& picture, double x, double y, double width) {
  constexpr int steps = 60;
  for (int n = 0; n < steps; ++n)
    picture.rectangle(x + width * n / steps, y, width / steps + 0.5, 9,
                      fit_error_colour(kFitErrorEnd_mm * (2.0 * n / (steps - 1) - 1)));
  const auto label = [&](double share, const std::string& text, Anchor anchor) {
    picture.text({x + width * share, y + 21}, text, 9, palette::quiet, anchor);
  };
  label(0, "mesh inside by " + word::number(kFitErrorEnd_mm, 0) + " mm or more", Anchor::start);
  label(0.5, "0", Anchor::middle);
  label(1, "outside by " + word::number(kFitErrorEnd_mm, 0) + " mm or more", Anchor::end);
}

/// Range of the errors where they were measured: between those points the field may overshoot.
std::pair<double, double> measured_range(const std::vector<double>& errors) {
  std::pair<double, double> range{errors.front(), errors.front()};
  constexpr int row = kSamples + 1;
  for (std::size_t n = 0; n < errors.size(); ++n) {
    if (n % row % kMeasured != 0 || n / row % row % kMeasured != 0) continue;
    range = {std::min(range.first, errors[n]), std::max(range.second, errors[n])};
  }
  return range;
}

}  // namespace

Colour fit_error_colour(double mm) { return palette::inside_outside(mm / kFitErrorEnd_mm); }

std::vector<double> fit_errors(const PatientResults& results, const std::vector<ElementFace>& faces,
                               int samples) {
  if (!results.prone || !results.prone->fields.count(kField)) return {};
  const MeshField field(results.prone->mesh, results.prone->fields.at(kField));
  std::vector<double> errors;
  for (const ElementFace& face : faces)
    for (int j = 0; j <= samples; ++j)
      for (int i = 0; i <= samples; ++i)
        errors.push_back(field.at(point_on_face(face, double(i) / samples, double(j) / samples)));
  return errors;
}

std::optional<Figure> fit_figure(const PatientResults& results) {
  if (!results.prone) return std::nullopt;
  // Elsewhere the field is no error of the fit.
  const std::vector<ElementFace> faces = skin_faces(*results.prone);
  const std::vector<double> errors = fit_errors(results, faces, kSamples);
  if (errors.empty()) return std::nullopt;
  const FaceTriangles skin = triangulate(results.prone->mesh, faces, kSamples);
  const Side side = results.segmentation ? results.segmentation->region.side : Side::left;
  Picture picture(2 * kWidth, kHeight + kLegend);
  double x = 0;
  for (const Eye& eye : kEyes) {
    picture.place(seen(skin, errors, eye_axes(side, eye.turn, eye.rise)), x, 0);
    picture.text({x + 6, 14}, eye.name, 10, palette::ink, Anchor::start, true);
    x += kWidth;
  }
  draw_legend(picture, kWidth / 2, kHeight + 8, kWidth);
  const auto [least, most] = measured_range(errors);
  const std::string range = "from " + word::number(least, 2) + " mm (inside) to " +
                            word::number(most, 2) + " mm (outside)";
  return Figure{
      picture, "How far the mesh's skin lies from the image's, painted on it: " + range + ".",
      "The prone breast's skin from two sides, coloured by the fit's error, " + range + "."};
}

}  // namespace mammotwin
