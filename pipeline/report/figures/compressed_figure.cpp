#include <algorithm>
#include <cmath>

#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/drawing/panel.h"
#include "pipeline/report/view_figures.h"
#include "pipeline/report/word.h"
#include "registration/carry/position_grid.h"

namespace mammotwin {
namespace {

constexpr double kWidth = 720;  // [pt]
constexpr double kGap = 14;     // [pt]
constexpr double kPixel_mm = 0.75;
constexpr double kPlate_mm = 4;    // drawn thickness of a plate
constexpr double kBehind_mm = 25;  // shown behind the detector's edge
constexpr double kMargin_mm = 14;  // room for plates and words

Eigen::AlignedBox3d window_of(const HermiteMesh& in_view, double thickness_mm) {
  Eigen::AlignedBox3d box = bounding_box(in_view);
  box.min() -= Eigen::Vector3d::Constant(kMargin_mm);
  box.max() += Eigen::Vector3d::Constant(kMargin_mm);
  box.min().x() = std::max(box.min().x(), -kBehind_mm);
  constexpr double kBeyondPlates_mm = 40;  // tissue behind the edge bulges past them
  box.min().z() = std::max(box.min().z(), -kBeyondPlates_mm);
  box.max().z() = std::min(box.max().z(), thickness_mm + kBeyondPlates_mm);
  return box;
}

/// Labels in the section, each pixel's tissue looked up where it was in the prone MRI.
Raster carried_labels(const PatientResults& results, const HermiteMesh& here, const Section& s) {
  const PointCarrier prone_from_here(here, results.prone->mesh);
  return s.sample(kPixel_mm, [&](const Eigen::Vector3d& x) -> Colour {
    const auto prone = prone_from_here.carry_inside(x);
    if (!prone) return palette::paper;
    if (!results.segmentation) return palette::fat;
    const auto& labels = results.segmentation->labels;
    const Eigen::Vector3i v = labels.index(*prone).array().round().cast<int>();
    if (!labels.contains(v.x(), v.y(), v.z())) return palette::fat;
    return palette::over(palette::of_label(labels(v.x(), v.y(), v.z())), palette::paper);
  });
}

/// Support and paddle with their front edge rounded by 10 mm, as the solver's default plates are.
void draw_plates(Picture& picture, const Panel& panel, double thickness_mm) {
  const double front = panel.section().window.max().x();
  constexpr double kRounding_mm = 10;
  const auto plate = [&](double face, double outwards) {
    Picture::Points points;
    for (int i = 0; i <= 8; ++i) {
      const double a =
          i / 8.0 * std::acos(1 - kPlate_mm / kRounding_mm);  // until it is a plate thick
      points.push_back(panel.at({kRounding_mm * (1 - std::sin(a)), 0,
                                 face + outwards * kRounding_mm * (1 - std::cos(a))}));
    }
    std::reverse(points.begin(), points.end());
    points.push_back(panel.at({front, 0, face}));
    points.push_back(panel.at({front, 0, face + outwards * kPlate_mm}));
    picture.polygon(points, palette::plate);
  };
  plate(0, -1);
  plate(thickness_mm, 1);
}

void draw_contents(Panel& panel, const PatientResults& results, const HermiteMesh& here,
                   const std::vector<ElementFace>& faces, const ViewProjection& projection,
                   const Landmark& lesion) {
  const Section& s = panel.section();
  panel.image(carried_labels(results, here, s));
  panel.pieces(cut_by_plane(here, faces, s.normal, s.at),
               {palette::with_alpha(palette::ink, 0.45), 0.5});
  panel.lesion_mark(projection.project(lesion).in_view, 6, lesion.id, false);
}

}  // namespace

Figure compressed_figure(const PatientResults& results, const ViewResult& view,
                         const Landmark& lesion) {
  const HermiteMesh here = in_view_frame(view.file.mesh, view.view.frame);
  const ViewProjection projection(results.prone->mesh, view.file.mesh, view.view, view.detector);
  const Eigen::Vector3d at = projection.project(lesion).in_view;
  const Eigen::AlignedBox3d window = window_of(here, view.view.thickness_mm);
  const std::vector<ElementFace> faces = all_faces(view.file);
  const Section across{1, at.y(), {0}, {2, true}, window};
  const Section along{2, at.z(), {0}, {1, true}, window};
  const double scale = (kWidth - kGap) / (across.width_mm() + along.width_mm());
  const double height = std::max(across.height_mm(), along.height_mm()) * scale;

  Picture picture(kWidth, height + 24);
  Panel left(picture, across, 0, 18, scale);
  Panel right(picture, along, left.width() + kGap, 18, scale);
  draw_contents(left, results, here, faces, projection, lesion);
  draw_plates(picture, left, view.view.thickness_mm);
  draw_contents(right, results, here, faces, projection, lesion);
  right.edge_line({0, window.min().y(), at.z()}, {0, window.max().y(), at.z()});
  left.title("Across the plates");
  right.title("Along the plates, from the tube");
  left.sides("wall", "", "paddle", "support", false);
  right.sides("wall", "", "lateral", "medial", false);
  for (Panel* panel : {&left, &right}) {
    panel->frame();
    panel->scale_bar(20, palette::ink);
  }
  const std::string name = title_of_view(view.view.name);
  const std::string where = "depth " + word::mm(at.x()) + ", lateral " + word::mm(at.y()) +
                            ", height " + word::mm(at.z()) + " mm";
  return {picture,
          name + ", compressed to " + word::mm(view.view.thickness_mm) + " mm, cut at lesion " +
              lesion.id + " (" + where + "). Tissue is that of the prone MRI, carried along.",
          "Two cuts through the compressed breast at lesion " + lesion.id + ", " + where +
              ", with support and paddle."};
}

}  // namespace mammotwin
