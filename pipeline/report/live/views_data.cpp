#include "pipeline/report/live/views_data.h"

#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/live/what_if_data.h"
#include "registration/carry/position_grid.h"

namespace mammotwin {
namespace {

using nlohmann::json;

json two_numbers(const Eigen::Vector2d& x) { return {x.x(), x.y()}; }

json one_view(const PatientResults& results, const ViewResult& view, const Section& section,
              int number) {
  const Eigen::Vector2d origin = section.on_paper(Eigen::Vector3d::Zero());
  const Eigen::AlignedBox3d box = bounding_box(in_view_frame(view.file.mesh, view.view.frame));
  const std::string further = number == 1 ? "" : "-" + std::to_string(number);
  return {{"name", view.view.name + further},
          {"view", view.view.name},
          {"title", title_of_view(view.view.name)},
          {"width_mm", section.width_mm()},
          {"origin", two_numbers(origin)},
          {"along_u", two_numbers(section.on_paper(Eigen::Vector3d::UnitX()) - origin)},
          {"along_v", two_numbers(section.on_paper(Eigen::Vector3d::UnitY()) - origin)},
          {"source_distance_mm", view.detector.source_distance_mm},
          {"support_gap_mm", view.detector.support_gap_mm},
          {"thickness_mm", view.view.thickness_mm},
          {"angle_deg", view.view.angle_deg},
          {"cranio_caudal", !is_oblique(view.view.angle_deg)},
          {"lowest_mm", box.min().z()},
          {"highest_mm", box.max().z()},
          {"what_if", number == 1 ? what_if_data(results, view) : json()}};
}

}  // namespace

json views_data(const PatientResults& results, const std::vector<Figure>& hung,
                const std::vector<const ViewResult*>& of_view) {
  json views = json::array();
  int number = 0;
  for (std::size_t v = 0; v < hung.size(); ++v) {
    number = v > 0 && of_view[v] == of_view[v - 1] ? number + 1 : 1;
    views.push_back(one_view(results, *of_view[v], hung[v].section.value(), number));
  }
  return {{"views", views},
          {"lesion_colour", palette::css(palette::lesion)},
          {"nipple_colour", palette::css(palette::nipple)},
          {"mark_colour", palette::css(palette::own_mark)}};
}

}  // namespace mammotwin
