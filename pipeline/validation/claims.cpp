#include "pipeline/validation/claims.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "pipeline/validation/lagrange/lagrange_cylinder.h"
#include "pipeline/validation/lagrange/strain_jump.h"

namespace mammotwin {

namespace {

struct Family {
  const char* name;
  int order;  ///< of Lagrange; 0: Hermite
  std::vector<int> meshes;
};

CylinderFigures squeeze(const CylinderExperiment& x, int order) {
  return order == 0 ? squeeze_cylinder(x) : squeeze_lagrange_cylinder(x, order);
}

std::string line(const char* pattern, auto... values) {
  char text[200];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace

std::vector<ClaimRow> compare_elements(const CylinderExperiment& lateral, const Say& say) {
  const Family families[] = {{"tri-cubic Hermite / trilinear", 0, {1, 2, 3, 4}},
                             {"trilinear / constant", 1, {2, 4, 6, 8}},
                             {"triquadratic / linear", 2, {1, 2, 3, 4}}};
  std::vector<ClaimRow> rows;
  CylinderExperiment x = lateral;
  for (const Family& family : families)
    for (int n : family.meshes) {
      x.elements = even_elements(n);
      ClaimRow row{family.name, squeeze(x, family.order)};
      row.strain_jump = strain_jump(row.figures.before.mesh, row.figures.after.mesh);
      say(row.name + ": " + std::to_string(row.figures.dof) + " unknowns");
      rows.push_back(std::move(row));
    }
  return rows;
}

std::vector<ClaimRow> compare_penalties(const CylinderExperiment& lateral, const Say& say) {
  std::vector<ClaimRow> rows;
  CylinderExperiment x = lateral;
  x.elements = even_elements(2);
  x.gap_tolerance = 0;
  for (double penalty : {0.1, 1.0, 10.0, 100.0, 1e3, 1e4})
    for (bool continued : {true, false}) {
      x.penalty = penalty;
      x.continued = continued;
      x.with_condition = continued;
      rows.push_back({"", squeeze_cylinder(x), 0, penalty, continued});
      say("penalty " + line("%g", penalty) + (continued ? ", raised to" : ", at once"));
    }
  return rows;
}

std::string element_table(const std::vector<ClaimRow>& rows, double force_N) {
  std::string text =
      "Elements (paper, 3.2), lateral cylinder\n"
      "displacement / pressure         unknowns  force N   err %  strain jump %  its   CPU s\n";
  for (const ClaimRow& r : rows)
    text += line("%-31s %8d %8.4f %+7.2f %14.2f %4d %7.2f%s\n", r.name.c_str(), r.figures.dof,
                 r.figures.force_N, 100 * (r.figures.force_N / force_N - 1), 100 * r.strain_jump,
                 r.figures.iterations, r.figures.cpu_seconds,
                 r.figures.usable ? "" : "  not converged");
  return text;
}

std::string penalty_table(const std::vector<ClaimRow>& rows, double force_N) {
  std::string text =
      "Penalty (paper, 2.3), lateral cylinder, in units of shear modulus / element size\n"
      " penalty  how        force N   err %  penetration mm  its  condition\n";
  for (const ClaimRow& r : rows) {
    text += line("%8g  %-9s %8.4f %+7.2f %15.6f %4d  ", r.penalty,
                 r.continued ? "raised to" : "at once", r.figures.force_N,
                 100 * (r.figures.force_N / force_N - 1), r.figures.penetration_mm,
                 r.figures.iterations);
    text += r.figures.condition > 0 ? line("%9.2g", r.figures.condition) : "";
    text += r.figures.usable ? "\n" : "  not converged\n";
  }
  return text;
}

nlohmann::json to_json(const std::vector<ClaimRow>& rows, double force_N) {
  nlohmann::json list = nlohmann::json::array();
  for (const ClaimRow& r : rows) {
    const CylinderFigures& f = r.figures;
    nlohmann::json row = {{"dof", f.dof},
                          {"force_N", f.force_N},
                          {"relative_error", f.force_N / force_N - 1},
                          {"max_penetration_mm", f.penetration_mm},
                          {"newton_iterations", f.iterations},
                          {"cpu_seconds", f.cpu_seconds},
                          {"converged", f.usable}};
    if (!r.name.empty()) row.update({{"element", r.name}, {"strain_jump", r.strain_jump}});
    if (r.penalty > 0) row.update({{"penalty", r.penalty}, {"raised", r.continued}});
    if (f.condition > 0) row["condition"] = f.condition;
    list.push_back(row);
  }
  return list;
}

}  // namespace mammotwin
