#include "pipeline/report/live/carry_data.h"

#include <cmath>
#include <limits>

#include "pipeline/report/live/deflated.h"
#include "registration/carry/point_carrier.h"
#include "registration/carry/position_grid.h"

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr double kValueStep_mm = 0.02;  // 16 bit then reach 655 mm to either side
constexpr std::int16_t kNowhere = std::numeric_limits<std::int16_t>::min();

json three_numbers(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

/// Nodes that are corners of a cell round the box, so that every place in it has eight.
PositionGrid nodes_round(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kCarryStep_mm);
  return cover({box.min() - margin, box.max() + margin}, kCarryStep_mm);
}

bool beside_tissue(const PositionGrid& inside, int i, int j, int k) {
  for (int c = k - 1; c <= k + 1; ++c)
    for (int b = j - 1; b <= j + 1; ++b)
      for (int a = i - 1; a <= i + 1; ++a)
        if (inside.contains(a, b, c) && inside(a, b, c).allFinite()) return true;
  return false;
}

/// Nodes just outside get where their place would go with the nearest tissue.
PositionGrid with_border(const PositionGrid& inside, const PointCarrier& carrier) {
  PositionGrid grid = inside;
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i)
        if (!inside(i, j, k).allFinite() && beside_tissue(inside, i, j, k))
          grid(i, j, k) = carrier.carry(grid.position(i, j, k)).in_lps;
  return grid;
}

void put_values(const PositionGrid& grid, const Eigen::Vector3d& middle, json& data) {
  std::vector<std::int16_t> values;
  for (const Eigen::Vector3d& x : grid.values)
    for (int axis = 0; axis < 3; ++axis)
      values.push_back(x.allFinite() ? static_cast<std::int16_t>(
                                           std::lround((x[axis] - middle[axis]) / kValueStep_mm))
                                     : kNowhere);
  data["middle"] = three_numbers(middle);
  data["step"] = kValueStep_mm;
  data["values"] = deflated(bytes_of(values));
}

json carry_grid(const HermiteMesh& here, const HermiteMesh& target) {
  PositionGrid inside = nodes_round(bounding_box(here));
  fill_positions(here, target, inside);
  std::vector<std::uint8_t> flags;
  for (const Eigen::Vector3d& x : inside.values) flags.push_back(x.allFinite());
  json data = {{"size", {inside.size.x(), inside.size.y(), inside.size.z()}},
               {"spacing", three_numbers(inside.spacing)},
               {"origin", three_numbers(inside.origin)},
               {"inside", deflated(flags)}};
  put_values(with_border(inside, PointCarrier(here, target)), bounding_box(target).center(), data);
  return data;
}

}  // namespace

json carry_data(const PatientResults& results) {
  json data = {{"prone_from", json::object()}, {"from_prone", json::object()}};
  for (const ViewResult& view : results.views) {
    const HermiteMesh pressed = in_view_frame(view.file.mesh, view.view.frame);
    data["prone_from"][view.view.name] = carry_grid(pressed, results.prone->mesh);
    data["from_prone"][view.view.name] = carry_grid(results.prone->mesh, pressed);
  }
  return data;
}

}  // namespace mammotwin
