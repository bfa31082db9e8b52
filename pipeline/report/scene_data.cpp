#include "pipeline/report/scene_data.h"

#include "pipeline/report/base64.h"
#include "pipeline/report/mesh_surface.h"
#include "pipeline/report/palette.h"
#include "registration/position_grid.h"

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr int kSamples = 8;          // squares a side of an element's face
constexpr double kMargin_mm = 10;    // plates reach this far past the breast

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

std::string packed_triangles(const TriangleSurface& surface) {
  std::vector<std::uint32_t> numbers;
  for (const auto& triangle : surface.triangles)
    numbers.insert(numbers.end(), triangle.begin(), triangle.end());
  return packed(numbers);
}

std::string packed_colours(const TriangleSurface& surface) {
  std::vector<float> numbers(3 * surface.points.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Colour c = surface.labels[i] == FaceLabel::chest_wall ? palette::muscle
                     : surface.labels[i] == FaceLabel::cut      ? palette::fat
                                                                : palette::skin;
    for (const int point : surface.triangles[i]) {
      numbers[3 * point] = static_cast<float>(c.red);
      numbers[3 * point + 1] = static_cast<float>(c.green);
      numbers[3 * point + 2] = static_cast<float>(c.blue);
    }
  }
  return packed(numbers);
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
  if (const auto nipple = results.nipple()) marks.push_back({{"nipple", *nipple}, 3, palette::nipple});
  return marks;
}

json view_data(const PatientResults& results, const ViewResult& view,
               const std::vector<ElementFace>& faces, const std::vector<Mark>& marks) {
  const PointCarrier carrier(results.prone->mesh, view.file.mesh);
  json places = json::array();
  for (const Mark& mark : marks)
    places.push_back(number_list(carrier.carry(mark.landmark.prone_in_lps).in_lps));
  const ViewFrame& frame = view.view.frame;
  const Eigen::AlignedBox3d box = bounding_box(in_view_frame(view.file.mesh, frame));
  const AffineBaseline baseline(results.prone->mesh, view.view);
  const double low = baseline.prone_low_mm();
  return {{"name", title_of_view(view.view.name)},
          {"points", packed_points(triangulate(view.file.mesh, faces, kSamples).points)},
          {"marks", places},
          {"support", plate(frame, box, 0)},
          {"paddle", plate(frame, box, view.view.thickness_mm)},
          {"support_open", plate(frame, box, low)},
          {"paddle_open", plate(frame, box, low + baseline.prone_extent_mm())}};
}

}  // namespace

json scene_data(const PatientResults& results) {
  const std::vector<ElementFace> faces = outer_faces(*results.prone);
  const TriangleSurface surface = triangulate(results.prone->mesh, faces, kSamples);
  const std::vector<Mark> marks = marks_of(results);
  json mark_list = json::array(), views = json::array();
  for (const Mark& mark : marks)
    mark_list.push_back({{"name", mark.landmark.id},
                         {"prone", number_list(mark.landmark.prone_in_lps)},
                         {"radius_mm", mark.radius_mm},
                         {"colour", hex(mark.colour)}});
  for (const ViewResult& view : results.views)
    views.push_back(view_data(results, view, faces, marks));
  return {{"triangles", packed_triangles(surface)},
          {"prone", packed_points(surface.points)},
          {"colours", packed_colours(surface)},
          {"marks", mark_list},
          {"views", views},
          {"turn", results.views.front().view.side == Side::left ? 1 : -1}};
}

}  // namespace mammotwin
