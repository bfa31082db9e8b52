#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "pipeline/report/drawing/lesion_outline.h"
#include "pipeline/report/drawing/mammogram_raster.h"
#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/drawing/panel.h"
#include "pipeline/report/view_figures.h"
#include "pipeline/report/word.h"
#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {
namespace {

constexpr double kScale = 2.0;  // [pt/mm]
constexpr double kMargin_mm = 10;
constexpr double kPixel_mm = 0.5;
constexpr double kMostBehind_mm = 25;
constexpr double kRing_mm = 5;       // where a lesion is but a point
constexpr double kEllipse_pt = 1.4;  // 2 px at the page's usual size
constexpr double kOutline_pt = 0.8;
constexpr double kFinding_pt = 1.0;

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

/// Lesions whose place without physics the picture does not reach.
std::vector<std::string> baseline_outside(const PatientResults& results,
                                          const ViewProjection& projection,
                                          const Section& section) {
  std::vector<std::string> names;
  for (const Landmark& lesion : results.lesions()) {
    const auto at = baseline_of(results, projection.view().name, projection.project(lesion));
    if (!section.window.contains(on_plane(at))) names.push_back(lesion.id);
  }
  return names;
}

/// Lesions that lie behind the edge, where no mammogram shows them.
std::vector<std::string> behind_edge(const PatientResults& results,
                                     const ViewProjection& projection) {
  std::vector<std::string> names;
  for (const Landmark& lesion : results.lesions())
    if (projection.project(lesion).on_detector.x() < 0) names.push_back(lesion.id);
  return names;
}

/// From behind the edge if a mark lies there or its ring reaches over it; not so far that a place
/// without physics leaves the breast no room.
double left_of_window(const PatientResults& results, const ViewProjection& projection) {
  double left = 0;
  for (const Landmark& lesion : results.lesions()) {
    const ProjectedLandmark p = projection.project(lesion);
    const double baseline = baseline_of(results, projection.view().name, p).x();
    left = std::min(
        {left, p.on_detector.x() - kMargin_mm, std::max(baseline - kMargin_mm, -kMostBehind_mm)});
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
Panel::Pieces ellipse_pieces(const LesionRow& row) {
  if (!row.ellipse_major_mm || !row.detector_u_mm) return {};
  const bool own = row.picture_ellipse_major_mm.has_value();
  const double major = own ? *row.picture_ellipse_major_mm : *row.ellipse_major_mm;
  const double minor = own ? *row.picture_ellipse_minor_mm : *row.ellipse_minor_mm;
  const double angle_deg = own ? *row.picture_ellipse_angle_deg : *row.ellipse_angle_deg;
  constexpr int corners = 72;
  const double turn = angle_deg * std::numbers::pi / 180;
  const auto at = [&](int n) {
    const double t = 2 * std::numbers::pi * n / corners;
    const double a = major * std::cos(t), b = minor * std::sin(t);
    return on_plane({*row.detector_u_mm + std::cos(turn) * a - std::sin(turn) * b,
                     *row.detector_v_mm + std::sin(turn) * a + std::cos(turn) * b});
  };
  Panel::Pieces pieces;
  for (int n = 0; n < corners; ++n) pieces.push_back({at(n), at(n + 1)});
  return pieces;
}

/// How far a lesion's ellipse reaches along u [mm]; a ring's radius where there is none.
double half_width(const PatientResults& results, const std::string& view,
                  const std::string& lesion) {
  for (const LesionRow& row : results.rows)
    if (row.view == view && row.lesion == lesion && row.detector_u_mm) {
      double reach = kRing_mm;
      for (const auto& [from, to] : ellipse_pieces(row))
        reach = std::max(reach, from.x() - *row.detector_u_mm);
      return reach;
    }
  return kRing_mm;
}

/// The lesions' own shadows' edges; a ring where a lesion is but a point.
void draw_lesions(Panel& panel, const PatientResults& results, const ViewProjection& projection) {
  const std::vector<Landmark> lesions = results.lesions();
  for (std::size_t n = 0; n < lesions.size(); ++n) {
    Panel::Pieces outline;
    if (results.segmentation)
      for (const auto& [a, b] :
           lesion_outline(results.segmentation->labels,
                          static_cast<std::uint8_t>(label::lesion + n), projection))
        outline.emplace_back(on_plane(a), on_plane(b));
    if (outline.empty())
      panel.lesion_mark(on_plane(projection.project(lesions[n]).on_detector), kRing_mm, "", true);
    else
      panel.edged_pieces(outline, palette::lesion, kOutline_pt);
  }
  if (const auto nipple = results.nipple())
    panel.nipple_triangle(on_plane(projection.project({"nipple", *nipple}).on_detector));
}

void draw_ellipses(Panel& panel, const PatientResults& results, const ViewProjection& projection) {
  for (const LesionRow& row : results.rows)
    if (row.view == projection.view().name)
      panel.edged_pieces(ellipse_pieces(row), palette::lesion, kEllipse_pt);
}

void draw_baseline(Panel& panel, const PatientResults& results, const ViewProjection& projection) {
  for (const Landmark& lesion : results.lesions())
    panel.baseline_mark(
        on_plane(baseline_of(results, projection.view().name, projection.project(lesion))));
}

void draw_labels(Panel& panel, const PatientResults& results, const ViewProjection& projection,
                 const std::string& name) {
  for (const Landmark& lesion : results.lesions())
    panel.label(on_plane(projection.project(lesion).on_detector),
                half_width(results, projection.view().name, lesion.id), lesion.id);
  const bool oblique = std::abs(projection.view().angle_deg) > 15;
  panel.sides("", "", name + (oblique ? ", superior-lateral" : ", lateral"),
              oblique ? "inferior-medial" : "medial", true);
  panel.scale_bar(20, palette::paper);
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

Panel::Pieces chain(const std::vector<Eigen::Vector2d>& pixels, const Detector& detector) {
  constexpr std::size_t kStride = 3;  // about 1 mm
  Panel::Pieces pieces;
  for (std::size_t n = kStride; n < pixels.size(); n += kStride)
    pieces.push_back({on_plane(detector.detector_from_image(pixels[n - kStride])),
                      on_plane(detector.detector_from_image(pixels[n]))});
  return pieces;
}

/// What the search was told of the mammogram: skin line, muscle's edge, nipple and its standard
/// deviation.
void draw_findings(Panel& panel, const RealMammogram& real) {
  const MammogramFindings& found = *real.findings;
  panel.edged_pieces(chain(found.outline, real.detector), palette::fat, kFinding_pt);
  panel.edged_pieces(chain(found.pectoral_curve, real.detector), palette::muscle, kFinding_pt);
  const Eigen::Vector2d nipple = real.detector.detector_from_image(found.nipple);
  constexpr int kCorners = 60;
  Panel::Pieces ring;
  const auto at = [&](int n) {
    const double t = 2 * std::numbers::pi * n / kCorners;
    return on_plane(nipple + found.nipple_sd_mm * Eigen::Vector2d(std::cos(t), std::sin(t)));
  };
  for (int n = 0; n < kCorners; ++n) ring.push_back({at(n), at(n + 1)});
  panel.edged_pieces(ring, palette::fat, kFinding_pt);
}

/// What the picture of a view consists of, before its background is chosen.
struct DetectorView {
  ViewProjection projection;
  DetectorImage simulated;
  Section section;
  std::string name;    ///< "L-CC"
  std::string hidden;  ///< sentences on places that a mammogram or the picture may not show
};

DetectorView detector_view(const PatientResults& results, const ViewResult& view) {
  ViewProjection projection(results.prone->mesh, view.file.mesh, view.view, view.detector);
  DetectorImage image = shown(results, view);
  const Section section =
      detector_section(image, view.view.side, left_of_window(results, projection));
  std::string hidden;
  for (const std::string& lesion : behind_edge(results, projection))
    hidden += " Lesion " + lesion +
              " is predicted behind the detector's edge: a mammogram may not show it.";
  for (const std::string& lesion : baseline_outside(results, projection, section))
    hidden += " Without physics lesion " + lesion + " would lie outside the picture.";
  const std::string name =
      (view.view.side == Side::right ? "R-" : "L-") + title_of_view(view.view.name);
  return {std::move(projection), std::move(image), section, name, hidden};
}

Figure drawn(const PatientResults& results, const DetectorView& view, const Raster& background,
             const std::string& caption, const std::string& alt) {
  const Section& section = view.section;
  const auto layer = [&](const std::function<void(Panel&)>& draw) {
    Picture picture(section.width_mm() * kScale, section.height_mm() * kScale);
    Panel panel(picture, section, 0, 0, kScale);
    draw(panel);
    return picture;
  };
  const ViewProjection& projection = view.projection;
  Figure figure{
      layer([&](Panel& panel) {
        panel.image(background);
        panel.edge_line({0, section.window.min().y(), 0}, {0, section.window.max().y(), 0});
      }),
      caption, alt};
  using Draw = void (*)(Panel&, const PatientResults&, const ViewProjection&);
  for (const auto& [name, draw] : {std::pair<const char*, Draw>("baseline", draw_baseline),
                                   std::pair<const char*, Draw>("ellipses", draw_ellipses),
                                   std::pair<const char*, Draw>("lesions", draw_lesions)})
    figure.layers.push_back({name, layer([&](Panel& panel) { draw(panel, results, projection); })});
  figure.layers.push_back(
      {"labels", layer([&](Panel& panel) { draw_labels(panel, results, projection, view.name); })});
  figure.section = section;
  return figure;
}

Figure simulated_figure(const PatientResults& results, const ViewResult& view,
                        const DetectorView& seen) {
  const double source_mm = view.detector.source_distance_mm;
  const std::string beam = source_mm < kParallel_mm
                               ? "cone beam, source at " + word::number(source_mm, 0) + " mm"
                               : std::string("parallel rays, as its slices are stacked");
  return drawn(
      results, seen, raster_of(seen.simulated, seen.section),
      seen.name + ", simulated from the compressed model (" + beam + ")." + seen.hidden,
      "Simulated " + seen.name + " mammogram." + described(results, seen.projection) + seen.hidden);
}

/// The patient's own mammogram, or a slice of it, under the predicted places.
Figure own_figure(const PatientResults& results, const DetectorView& seen,
                  const RealMammogram& real, const MammogramImage& image,
                  const std::string& which) {
  Figure figure =
      drawn(results, seen, mammogram_raster(image, real.detector, seen.section, kPixel_mm),
            "The patient's own " + seen.name + which +
                (results.not_registered(real.view).empty()
                     ? " with the predicted places."
                     : ", not registered, with the places predicted without it.") +
                seen.hidden,
            "The patient's " + seen.name + " mammogram" + which + "." +
                described(results, seen.projection) + seen.hidden);
  if (real.slices.empty()) figure.native = native_mammogram(image, real.detector, seen.section);
  if (!real.findings) return figure;
  Picture picture(seen.section.width_mm() * kScale, seen.section.height_mm() * kScale);
  Panel panel(picture, seen.section, 0, 0, kScale);
  draw_findings(panel, real);
  figure.layers.insert(figure.layers.begin(), {"findings", picture});
  return figure;
}

/// ", slice 23 of 57 (lesion L1)".
std::string name_of_slice(const PatientResults& results, const RealMammogram& real, int slice) {
  std::string lesions;
  for (const LesionRow& row : results.rows)
    if (row.view == real.view && row.slice && real.detector.slices->nearest(*row.slice) == slice)
      lesions += (lesions.empty() ? "lesion " : ", ") + row.lesion;
  return ", slice " + std::to_string(slice) + " of " + std::to_string(real.detector.slices->count) +
         " (" + lesions + ")";
}

}  // namespace

std::vector<Figure> detector_figures(const PatientResults& results, const ViewResult& view) {
  const DetectorView seen = detector_view(results, view);
  std::vector<Figure> figures;
  if (const RealMammogram* real = results.mammogram(view.view.name)) {
    figures.push_back(own_figure(results, seen, *real, real->image,
                                 real->slices.empty() ? "" : ", mean of all slices,"));
    for (const auto& [slice, image] : real->slices)
      figures.push_back(
          own_figure(results, seen, *real, image, name_of_slice(results, *real, slice)));
  }
  figures.push_back(simulated_figure(results, view, seen));
  return figures;
}

}  // namespace mammotwin
