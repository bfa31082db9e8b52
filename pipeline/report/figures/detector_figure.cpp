#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/report/mammogram_raster.h"
#include "pipeline/report/mesh_surface.h"
#include "pipeline/report/palette.h"
#include "pipeline/report/panel.h"
#include "pipeline/report/view_figures.h"
#include "pipeline/report/word.h"
#include "registration/view/simulated_mammogram.h"

namespace mammotwin {
namespace {

constexpr double kScale = 2.0;  // [pt/mm]
constexpr double kMargin_mm = 10;
constexpr double kPixel_mm = 0.5;

/// Detector coordinates in space: (u, v, 0).
Eigen::Vector3d on_plane(const Eigen::Vector2d& uv) { return {uv.x(), uv.y(), 0}; }

DetectorImage shown(const PatientResults& results, const ViewResult& view) {
  const bool tissue = results.segmentation && !results.segmentation->fractions.values.empty();
  return as_shown(simulate_view(results.prone->mesh, view.file.mesh,
                                tissue ? &results.segmentation->fractions : nullptr, view.view,
                                view.detector, kPixel_mm));
}

/// Where the baseline puts a lesion: as the table says, which knows how register laid it on a
/// mammogram.
Eigen::Vector2d baseline_of(const PatientResults& results, const std::string& view,
                            const ProjectedLandmark& p) {
  for (const LesionRow& row : results.rows)
    if (row.view == view && row.lesion == p.landmark.id && row.baseline_u_mm && row.baseline_v_mm)
      return {*row.baseline_u_mm, *row.baseline_v_mm};
  return p.baseline_on_detector;
}

/// Lesions that lie behind the edge, where no mammogram shows them.
std::vector<std::string> behind_edge(const PatientResults& results,
                                     const ViewProjection& projection) {
  std::vector<std::string> names;
  for (const Landmark& lesion : results.lesions())
    if (projection.project(lesion).on_detector.x() < 0) names.push_back(lesion.id);
  return names;
}

/// From behind the edge if a mark lies there or its ring reaches over it.
double left_of_window(const PatientResults& results, const ViewProjection& projection) {
  double left = 0;
  for (const Landmark& lesion : results.lesions()) {
    const ProjectedLandmark p = projection.project(lesion);
    const double baseline = baseline_of(results, projection.view().name, p).x();
    left = std::min({left, p.on_detector.x() - kMargin_mm, baseline - kMargin_mm});
  }
  return left;
}

Section detector_section(const DetectorImage& image, Side side, double left) {
  const Eigen::Vector2d last =
      image.first + image.spacing_mm * Eigen::Vector2d(image.columns, image.rows);
  Section s;
  s.normal = 2;
  s.right = {0, side == Side::right};  // chest walls meet in the middle, as mammograms are hung
  s.down = {1, true};
  s.window = Eigen::AlignedBox3d(Eigen::Vector3d(left, image.first.y() - kMargin_mm, 0),
                                 Eigen::Vector3d(last.x() + kMargin_mm, last.y() + kMargin_mm, 0));
  return s;
}

Raster raster_of(const DetectorImage& image, const Section& section) {
  return section.sample(kPixel_mm, [&](const Eigen::Vector3d& x) -> Colour {
    const Eigen::Vector2d index = (Eigen::Vector2d(x.x(), x.y()) - image.first) / image.spacing_mm;
    const int i = static_cast<int>(std::lround(index.x()));
    const int j = static_cast<int>(std::lround(index.y()));
    const bool inside = i >= 0 && j >= 0 && i < image.columns && j < image.rows;
    if (x.x() < 0) return palette::grid;
    const double g = 0.04 + 0.96 * (inside ? image.at(i, j) : 0);
    return {g, g, g};
  });
}

/// The lesion's 90 % ellipse of lesions.csv, as a closed line round its place; that in the model's
/// own picture where there is one.
void draw_ellipse(Panel& panel, const LesionRow& row) {
  if (!row.ellipse_major_mm || !row.detector_u_mm) return;
  const bool own = row.picture_ellipse_major_mm.has_value();
  const double major = own ? *row.picture_ellipse_major_mm : *row.ellipse_major_mm;
  const double minor = own ? *row.picture_ellipse_minor_mm : *row.ellipse_minor_mm;
  const double angle_deg = own ? *row.picture_ellipse_angle_deg : *row.ellipse_angle_deg;
  constexpr int corners = 48;
  const double turn = angle_deg * std::numbers::pi / 180;
  const auto at = [&](int n) {
    const double t = 2 * std::numbers::pi * n / corners;
    const double a = major * std::cos(t), b = minor * std::sin(t);
    return on_plane({*row.detector_u_mm + std::cos(turn) * a - std::sin(turn) * b,
                     *row.detector_v_mm + std::sin(turn) * a + std::cos(turn) * b});
  };
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pieces;
  for (int n = 0; n < corners; ++n) pieces.push_back({at(n), at(n + 1)});
  panel.pieces(pieces, {palette::lesion, 1});
}

void draw_landmarks(Panel& panel, const PatientResults& results, const ViewProjection& projection) {
  for (const Landmark& lesion : results.lesions()) {
    const ProjectedLandmark p = projection.project(lesion);
    panel.baseline_mark(on_plane(baseline_of(results, projection.view().name, p)), lesion.id);
    panel.lesion_mark(on_plane(p.on_detector), 5, lesion.id, true);
  }
  for (const LesionRow& row : results.rows)
    if (row.view == projection.view().name) draw_ellipse(panel, row);
  if (const auto nipple = results.nipple())
    panel.nipple_mark(on_plane(projection.project({"nipple", *nipple}).on_detector), true);
}

std::string described(const PatientResults& results, const ViewProjection& projection) {
  std::string text;
  for (const Landmark& lesion : results.lesions()) {
    const ProjectedLandmark p = projection.project(lesion);
    text += " Lesion " + lesion.id + " at u " + word::mm(p.on_detector.x()) + ", v " +
            word::mm(p.on_detector.y()) + " mm.";
  }
  return text;
}

/// What the picture of a view consists of, before its background is chosen.
struct DetectorView {
  ViewProjection projection;
  DetectorImage simulated;
  Section section;
  std::string name;    ///< "L-CC"
  std::string hidden;  ///< sentences on lesions that no mammogram shows
};

DetectorView detector_view(const PatientResults& results, const ViewResult& view) {
  ViewProjection projection(results.prone->mesh, view.file.mesh, view.view, view.detector);
  DetectorImage image = shown(results, view);
  const Section section =
      detector_section(image, view.view.side, left_of_window(results, projection));
  std::string hidden;
  for (const std::string& lesion : behind_edge(results, projection))
    hidden +=
        " Lesion " + lesion + " lies behind the detector's edge: a mammogram would not show it.";
  const std::string name =
      (view.view.side == Side::right ? "R-" : "L-") + title_of_view(view.view.name);
  return {std::move(projection), std::move(image), section, name, hidden};
}

Picture drawn(const PatientResults& results, const DetectorView& view, const Raster& background,
              const std::string& title) {
  const Section& section = view.section;
  Picture picture(section.width_mm() * kScale, section.height_mm() * kScale + 20);
  Panel panel(picture, section, 0, 18, kScale);
  panel.image(background);
  panel.edge_line({0, section.window.min().y(), 0}, {0, section.window.max().y(), 0});
  draw_landmarks(panel, results, view.projection);
  const bool oblique = std::abs(view.projection.view().angle_deg) > 15;
  panel.sides("", "", oblique ? "superior-lateral" : "lateral",
              oblique ? "inferior-medial" : "medial", true);
  panel.scale_bar(20, palette::paper);
  panel.title(title);
  return picture;
}

Figure simulated_figure(const PatientResults& results, const ViewResult& view,
                        const DetectorView& seen) {
  return {
      drawn(results, seen, raster_of(seen.simulated, seen.section), seen.name + ", simulated"),
      seen.name + " on the detector, simulated from the compressed model (cone beam, source at " +
          word::number(view.detector.source_distance_mm, 0) + " mm)." + seen.hidden,
      "Simulated " + seen.name + " mammogram." + described(results, seen.projection) + seen.hidden};
}

Figure own_figure(const PatientResults& results, const DetectorView& seen,
                  const RealMammogram& real) {
  return {drawn(results, seen, mammogram_raster(real, seen.section, kPixel_mm),
                seen.name + ", mammogram"),
          "The patient's own " + seen.name + " mammogram with the predicted places." + seen.hidden,
          "The patient's " + seen.name + " mammogram." + described(results, seen.projection) +
              seen.hidden};
}

}  // namespace

std::vector<Figure> detector_figures(const PatientResults& results, const ViewResult& view) {
  const DetectorView seen = detector_view(results, view);
  std::vector<Figure> figures;
  if (const RealMammogram* real = results.mammogram(view.view.name))
    figures.push_back(own_figure(results, seen, *real));
  figures.push_back(simulated_figure(results, view, seen));
  return figures;
}

}  // namespace mammotwin
