#include "registration/mammogram/findings_json.h"

#include <nlohmann/json.hpp>

namespace mammotwin {
namespace {

using nlohmann::json;

json pixel(const Eigen::Vector2d& x) { return {x.x(), x.y()}; }

json pixels(const std::vector<Eigen::Vector2d>& line) {
  json list = json::array();
  for (const Eigen::Vector2d& x : line) list.push_back(pixel(x));
  return list;
}

}  // namespace

json findings_json(const MammogramFindings& f) {
  json candidates = json::array();
  for (const auto& c : f.nipples)
    candidates.push_back({{"pixel", pixel(c.pixel)}, {"probability", c.probability}});
  json pectoral = nullptr;
  if (f.pectoral)
    pectoral = {{"line_pixels", {pixel(f.pectoral->first), pixel(f.pectoral->second)}},
                {"curve_pixels", pixels(f.pectoral_curve)},
                {"sd_mm", f.pectoral_sd_mm}};
  return {{"chest_wall", f.chest_wall == ImageEdge::left ? "left" : "right"},
          {"outline_pixels", pixels(f.outline)},
          {"outline_sd_mm", f.outline_sd_mm},
          {"nipple",
           {{"pixel", pixel(f.nipple)},
            {"sd_mm", f.nipple_sd_mm},
            {"evidence", name_of(f.evidence)},
            {"candidates", candidates}}},
          {"pectoral", pectoral},
          {"unsure", f.unsure},
          {"remarks", f.remarks}};
}

json geometry_json(const HeaderGeometry& g) {
  const PixelGrid& grid = *g.detector.pixels;
  const auto known = [](const std::optional<double>& x) { return x ? json(*x) : json(); };
  json geometry{{"angle_deg", g.angle_deg},
                {"thickness_mm", known(g.thickness_mm)},
                {"force_N", known(g.force_N)},
                {"source_distance_mm", g.detector.source_distance_mm},
                {"support_gap_mm", g.detector.support_gap_mm},
                {"pixel_spacing_mm", grid.spacing_mm},
                {"columns", grid.columns},
                {"rows", grid.rows},
                {"chest_wall", grid.chest_wall == ImageEdge::left ? "left" : "right"},
                {"lateral", grid.lateral_at_top ? "top" : "bottom"},
                {"remarks", g.remarks}};
  if (const auto& s = g.detector.slices)
    geometry["slices"] = {{"count", s->count},
                          {"spacing_mm", s->spacing_mm},
                          {"lowest_mm", s->lowest_mm},
                          {"first", s->first_at_support ? "support" : "paddle"}};
  return geometry;
}

}  // namespace mammotwin
