#include "pipeline/report/figures/render_figure.h"

#include <Eigen/Geometry>

#include "pipeline/report/drawing/depth_image.h"
#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/drawing/surface_render.h"
#include "pipeline/report/word.h"
#include "registration/carry/position_grid.h"

namespace mammotwin {
namespace {

constexpr double kWidth = 350, kHeight = 300;  // [pt]
constexpr double kPixelsPerPoint = 2;
constexpr int kSamples = 10;                 // squares a side of an element's face
constexpr double kTurn = 0.7, kRise = 0.35;  // of the eye [rad]
constexpr double kSkinOpacity = 0.55;        // lesions show through

Colour surface_colour(FaceLabel label) {
  switch (label) {
    case FaceLabel::chest_wall:
      return palette::muscle;
    case FaceLabel::cut:
      return palette::fat;
    default:
      return palette::over(palette::with_alpha(palette::skin, 0.45), palette::paper);
  }
}

/// Corners of a plate in LPS, in order round it.
std::array<Eigen::Vector3d, 4> plate_corners(const ViewFrame& frame, const Eigen::AlignedBox3d& box,
                                             double height) {
  const double front = box.max().x() + 8, low = box.min().y() - 8, high = box.max().y() + 8;
  return {frame.lps_from_view({0, low, height}), frame.lps_from_view({front, low, height}),
          frame.lps_from_view({front, high, height}), frame.lps_from_view({0, high, height})};
}

Picture::Points on_paper(const DepthImage& image, const Eigen::Matrix3d& axes,
                         const std::array<Eigen::Vector3d, 4>& corners) {
  Picture::Points points;
  for (const Eigen::Vector3d& x : corners)
    points.push_back(image.pixel(axes * x) / kPixelsPerPoint);
  return points;
}

struct Scene {
  FaceTriangles surface;
  Eigen::Matrix3d axes;
  Eigen::AlignedBox2d window;
};

Scene make_scene(const MeshFile& file, const HermiteMesh& mesh, Side side) {
  Scene scene{triangulate(mesh, outer_faces(file), kSamples), eye_axes(side, kTurn, kRise), {}};
  for (const Eigen::Vector3d& x : scene.surface.points)
    scene.window.extend((scene.axes * x).head<2>().eval());
  return scene;
}

}  // namespace

std::vector<BreastShape> breast_shapes(const PatientResults& results) {
  std::vector<BreastShape> shapes{{"Prone", "Prone, as in the MRI.", &results.prone->mesh}};
  if (results.unloaded && results.unloaded->num_elements() == results.prone->mesh.num_elements())
    shapes.push_back({"Unloaded", "Unloaded: free of gravity and stress, where the plates begin.",
                      &*results.unloaded});
  for (const ViewResult& view : results.views) {
    const std::string name = title_of_view(view.view.name);
    shapes.push_back(
        {name, name + ", between support and paddle (" + word::mm(view.view.thickness_mm) + " mm).",
         &view.file.mesh, &view});
  }
  return shapes;
}

Figure render_figure(const PatientResults& results, const BreastShape& shape) {
  const ViewResult* view = shape.view;
  const Side side = view                   ? view->view.side
                    : results.segmentation ? results.segmentation->region.side
                                           : Side::left;
  Scene scene = make_scene(view ? view->file : *results.prone, *shape.mesh, side);
  Eigen::AlignedBox3d in_view;
  if (view) {
    in_view = bounding_box(in_view_frame(*shape.mesh, view->view.frame));
    for (const double h : {0.0, view->view.thickness_mm})
      for (const Eigen::Vector3d& x : plate_corners(view->view.frame, in_view, h))
        scene.window.extend((scene.axes * x).head<2>().eval());
  }
  const int width = static_cast<int>(kWidth * kPixelsPerPoint);
  const int height = static_cast<int>(kHeight * kPixelsPerPoint);
  const double pixel_mm =
      1.08 * std::max(scene.window.sizes().x() / width, scene.window.sizes().y() / height);
  const Eigen::Vector2d corner =
      scene.window.center() - 0.5 * pixel_mm * Eigen::Vector2d(width, height);
  DepthImage far_side(width, height, corner, pixel_mm), near_side(width, height, corner, pixel_mm);
  const auto colour = [&](std::size_t i) { return surface_colour(scene.surface.labels[i]); };
  draw_surface(far_side, scene.surface, scene.axes, false, colour);
  draw_surface(near_side, scene.surface, scene.axes, true, colour);

  Picture picture(kWidth, kHeight);
  if (view)
    picture.polygon(on_paper(far_side, scene.axes, plate_corners(view->view.frame, in_view, 0)),
                    palette::with_alpha(palette::plate, 0.45));
  picture.image(far_side.raster(), 0, 0, kWidth, kHeight);
  const PointCarrier carrier(results.prone->mesh, *shape.mesh);
  const auto place = [&](const Eigen::Vector3d& prone) {
    return (far_side.pixel(scene.axes * carrier.carry(prone).in_lps) / kPixelsPerPoint).eval();
  };
  for (const Landmark& lesion : results.lesions())
    picture.disc(place(lesion.prone_in_lps), std::max(3.0, 5 / pixel_mm / kPixelsPerPoint),
                 palette::lesion);
  Raster glass = near_side.raster();
  for (Colour& colour : glass.pixels) colour.alpha *= kSkinOpacity;
  picture.image(glass, 0, 0, kWidth, kHeight);
  if (view) {
    const auto paddle = on_paper(far_side, scene.axes,
                                 plate_corners(view->view.frame, in_view, view->view.thickness_mm));
    picture.polygon(paddle, palette::with_alpha(palette::plate, 0.22));
    picture.outline(paddle, {palette::plate, 1});
  }
  for (const Landmark& lesion : results.lesions())
    picture.text(place(lesion.prone_in_lps) + Eigen::Vector2d(7, 3), lesion.id, 9, palette::lesion,
                 Anchor::start, true);
  if (const auto nipple = results.nipple()) picture.disc(place(*nipple), 3, palette::nipple);
  picture.text({6, 14}, shape.name, 11, palette::ink, Anchor::start, true);
  return {picture, shape.caption,
          shape.name + " breast seen obliquely from the front, with lesions and nipple."};
}

}  // namespace mammotwin
