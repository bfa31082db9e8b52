#include "pipeline/report/live/scene_data.h"

#include <algorithm>
#include <cmath>

#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/figures/fit_error.h"
#include "pipeline/report/live/base64.h"
#include "registration/carry/position_grid.h"

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr int kSamples = 8;        // squares a side of an element's face
constexpr double kMargin_mm = 10;  // plates reach this far past the breast

template <class T>
std::string packed(const std::vector<T>& numbers) {
  return base64(numbers.data(), numbers.size() * sizeof(T));
}

std::string packed_points(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> numbers;
  for (const Eigen::Vector3d& p : points)
    for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(p[i]));
  return packed(numbers);
}

std::string packed_triangles(const FaceTriangles& surface) {
  std::vector<std::uint32_t> numbers;
  for (const auto& triangle : surface.triangles)
    numbers.insert(numbers.end(), triangle.begin(), triangle.end());
  return packed(numbers);
}

/// Colours of the points, each from its triangles' label and its own index.
template <class ColourOf>
std::string packed_colours(const FaceTriangles& surface, ColourOf colour_of) {
  std::vector<float> numbers(3 * surface.points.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (const int point : surface.triangles[i]) {
      const Colour c = colour_of(surface.labels[i], point);
      numbers[3 * point] = static_cast<float>(c.red);
      numbers[3 * point + 1] = static_cast<float>(c.green);
      numbers[3 * point + 2] = static_cast<float>(c.blue);
    }
  return packed(numbers);
}

Colour tissue_colour(FaceLabel label, int) {
  return label == FaceLabel::chest_wall ? palette::muscle
         : label == FaceLabel::cut
             ? palette::fat
             : palette::over(palette::with_alpha(palette::skin, 0.45), palette::paper);
}

/// The fit's error on the skin; the faces that have none keep a grey.
std::string packed_fit_errors(const FaceTriangles& surface, const std::vector<double>& errors) {
  return packed_colours(surface, [&](FaceLabel label, int point) {
    return label == FaceLabel::skin ? fit_error_colour(errors[point]) : palette::grid;
  });
}

json number_list(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

int hex(const Colour& c) {
  const auto byte = [](double v) { return static_cast<int>(std::lround(v * 255)); };
  return byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

json plate(const ViewFrame& frame, const Eigen::AlignedBox3d& box, double height) {
  const double front = box.max().x() + kMargin_mm;
  const double low = box.min().y() - kMargin_mm, high = box.max().y() + kMargin_mm;
  return {number_list(frame.lps_from_view({0, low, height})),
          number_list(frame.lps_from_view({front, low, height})),
          number_list(frame.lps_from_view({front, high, height})),
          number_list(frame.lps_from_view({0, high, height}))};
}

struct Mark {
  Landmark landmark;
  double radius_mm;
  Colour colour;
};

std::vector<Mark> marks_of(const PatientResults& results) {
  std::vector<Mark> marks;
  for (const Landmark& lesion : results.lesions()) marks.push_back({lesion, 4.5, palette::lesion});
  if (const auto nipple = results.nipple())
    marks.push_back({{"nipple", *nipple}, 3, palette::nipple});
  return marks;
}

/// The breast's surface and the marks in one configuration.
json state_data(const std::string& name, const PatientResults& results, const HermiteMesh& mesh,
                const std::vector<ElementFace>& faces, const std::vector<Mark>& marks) {
  const PointCarrier carrier(results.prone->mesh, mesh);
  json places = json::array();
  for (const Mark& mark : marks)
    places.push_back(number_list(carrier.carry(mark.landmark.prone_in_lps).in_lps));
  return {{"name", name},
          {"points", packed_points(triangulate(mesh, faces, kSamples).points)},
          {"marks", places}};
}

json view_data(const PatientResults& results, const ViewResult& view,
               const std::vector<ElementFace>& faces, const std::vector<Mark>& marks) {
  const ViewFrame& frame = view.view.frame;
  const Eigen::AlignedBox3d box = bounding_box(in_view_frame(view.file.mesh, frame));
  const AffineBaseline baseline(results.prone->mesh, view.view);
  const double low = baseline.prone_low_mm();
  json data = state_data(title_of_view(view.view.name), results, view.file.mesh, faces, marks);
  data["thickness_mm"] = view.view.thickness_mm;
  data["open_mm"] = baseline.prone_extent_mm();
  data["support"] = plate(frame, box, 0);
  data["paddle"] = plate(frame, box, view.view.thickness_mm);
  data["support_open"] = plate(frame, box, low);
  data["paddle_open"] = plate(frame, box, low + baseline.prone_extent_mm());
  return data;
}

}  // namespace

json scene_data(const PatientResults& results) {
  const std::vector<ElementFace> faces = outer_faces(*results.prone);
  const FaceTriangles surface = triangulate(results.prone->mesh, faces, kSamples);
  const std::vector<Mark> marks = marks_of(results);
  json mark_list = json::array(), states = json::array(), views = json::array();
  for (const Mark& mark : marks)
    mark_list.push_back(
        {{"name", mark.landmark.id}, {"radius_mm", mark.radius_mm}, {"colour", hex(mark.colour)}});
  states.push_back(state_data("Prone", results, results.prone->mesh, faces, marks));
  if (results.unloaded && results.unloaded->num_elements() == results.prone->mesh.num_elements())
    states.push_back(state_data("Unloaded", results, *results.unloaded, faces, marks));
  for (const ViewResult& view : results.views)
    views.push_back(view_data(results, view, faces, marks));
  json scene = {{"triangles", packed_triangles(surface)},
                {"tissue", packed_colours(surface, tissue_colour)},
                {"marks", mark_list},
                {"states", states},
                {"views", views},
                {"turn", results.views.front().view.side == Side::left ? 1 : -1}};
  const std::vector<double> errors = fit_errors(results, faces, kSamples);
  if (!errors.empty()) scene["fit_error"] = packed_fit_errors(surface, errors);
  return scene;
}

}  // namespace mammotwin
