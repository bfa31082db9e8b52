#include "pipeline/validation/gel_result.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace mammotwin {

namespace {

using Expected = std::optional<double>;

struct Quantity {
  const char* key;
  double CylinderFigures::*found;
  Expected GelCase::*expected;
};
constexpr Quantity kLengths[] = {
    {"half_width_middle_mm", &CylinderFigures::half_width_middle_mm,
     &GelCase::half_width_middle_mm},
    {"half_width_end_mm", &CylinderFigures::half_width_end_mm, &GelCase::half_width_end_mm},
    {"half_length_axis_mm", &CylinderFigures::half_length_axis_mm, &GelCase::half_length_axis_mm}};

nlohmann::json number(const Expected& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

/// A value beside its reference: the key in the entry, in `reference` and in `relative_error`.
void put(nlohmann::json& entry, const char* key, double found, const Expected& expected) {
  entry[key] = found;
  entry["reference"][key] = number(expected);
  entry["relative_error"][key] =
      expected ? nlohmann::json(relative_error(found, expected)) : nlohmann::json();
}

void put_figures(nlohmann::json& entry, const GelCase& c, const CylinderFigures& f) {
  put(entry, "force_N", f.force_N, c.force_N);
  for (const Quantity& q : kLengths) put(entry, q.key, f.*q.found, c.*q.expected);
  const Expected& width = c.half_width_middle_mm;
  put(entry, "radial_stretch", f.half_width_middle_mm / c.radius_mm(),
      width ? Expected(*width / c.radius_mm()) : std::nullopt);
  put(entry, "radial_strain", f.half_width_middle_mm / c.radius_mm() - 1,
      width ? Expected(*width / c.radius_mm() - 1) : std::nullopt);
  entry["seconds"] = f.seconds;
  entry["cpu_seconds"] = f.cpu_seconds;
  entry["dof"] = f.dof;
  entry["elements"] = f.elements;
  entry["newton_iterations"] = f.iterations;
  entry["max_penetration_mm"] = f.penetration_mm;
  entry["min_J"] = f.min_J;
  entry["max_J"] = f.max_J;
  entry["reason"] = f.usable ? nlohmann::json() : nlohmann::json(f.reason);
}

/// The point of other codes' curve at a thickness, if they have one.
const GelCurvePoint* point_at(const GelCase& c, double thickness_mm) {
  constexpr double same = 1e-6;
  for (const GelCurvePoint& p : c.curve)
    if (std::abs(p.thickness_mm - thickness_mm) < same) return &p;
  return nullptr;
}

nlohmann::json curve_of(const GelResult& r) {
  nlohmann::json rows = nlohmann::json::array();
  for (const CylinderStep& step : r.curve) {
    nlohmann::json row = {{"thickness_mm", step.thickness_mm}};
    const GelCurvePoint* point = point_at(r.experiment, step.thickness_mm);
    put(row, "force_N", step.force_N, point ? Expected(point->force_N) : std::nullopt);
    put(row, "half_width_middle_mm", step.half_width_middle_mm,
        point ? point->half_width_middle_mm : std::nullopt);
    rows.push_back(row);
  }
  return rows;
}

std::string percent(double fraction) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * fraction);
  return text;
}

void check(const std::string& what, double error, double allowed,
           const std::function<std::string(double)>& text, std::vector<std::string>& missed) {
  if (!(std::abs(error) <= allowed))
    missed.push_back(what + " is off by " + text(error) + "; allowed are " + text(allowed));
}

}  // namespace

double relative_error(double found, const Expected& expected) {
  return expected ? found / *expected - 1 : std::numeric_limits<double>::quiet_NaN();
}

GelResult run_gel_case(const GelCase& c, const std::function<void(const std::string&)>& say) {
  GelResult result{c, squeeze_cylinder(c.experiment), {}, {}, {}};
  say(c.name + ": recommended mesh, " + std::to_string(result.figures.dof) + " unknowns");
  CylinderExperiment other = c.experiment;
  for (const CylinderElements& elements : c.study) {
    other.elements = elements;
    result.study.push_back(squeeze_cylinder(other));
    say(c.name + ": " + std::to_string(result.study.back().dof) + " unknowns");
  }
  if (c.curve_steps > 0) {
    other = c.experiment;
    other.steps = c.curve_steps;
    result.curve = squeeze_cylinder(other).history;
    say(c.name + ": " + std::to_string(c.curve_steps) + " load steps");
  }
  if (c.as_the_paper_ran_it) {
    other = c.experiment;
    other.part = CylinderPart::half;
    result.half = squeeze_cylinder(other);
    say(c.name + ": half the cylinder, one plate");
  }
  return result;
}

nlohmann::json to_json(const GelResult& r) {
  nlohmann::json entry = nlohmann::json::object();
  put_figures(entry, r.experiment, r.figures);
  entry["study"] = nlohmann::json::array();
  for (const CylinderFigures& f : r.study)
    put_figures(entry["study"].emplace_back(), r.experiment, f);
  entry["curve"] = curve_of(r);
  entry["as_the_paper_ran_it"] = nullptr;
  if (r.half) {
    entry["as_the_paper_ran_it"] = nlohmann::json::object();
    put_figures(entry["as_the_paper_ran_it"], r.experiment, *r.half);
  }
  return entry;
}

nlohmann::json mesh_rows(const GelResult& r) {
  const GelCase& c = r.experiment;
  nlohmann::json rows = nlohmann::json::array();
  const auto add = [&](const std::string& mesh, const CylinderFigures& f) {
    const auto off = [&](const char* key, double error, const Expected& expected) {
      rows.back()[key] = expected ? nlohmann::json(error) : nlohmann::json();
    };
    rows.push_back({{"case", c.name},
                    {"mesh", mesh},
                    {"unknowns", f.dof},
                    {"force_N", f.force_N},
                    {"newton_iterations", f.iterations},
                    {"cpu_seconds", f.cpu_seconds}});
    const Expected& width = c.half_width_middle_mm;
    off("force_off_percent", 100 * relative_error(f.force_N, c.force_N), c.force_N);
    off("half_width_off_mm", f.half_width_middle_mm - width.value_or(0), width);
    off("radial_strain_off_percent",
        100 * (f.half_width_middle_mm - width.value_or(0)) / (width.value_or(0) - c.radius_mm()),
        width);
  };
  for (const CylinderFigures& f : r.study) add("study", f);
  add("recommended", r.figures);
  return rows;
}

std::vector<std::string> missed_targets(const GelResult& r) {
  const GelCase& c = r.experiment;
  if (!r.figures.usable) return {c.name + ": did not converge: " + r.figures.reason};
  std::vector<std::string> missed;
  if (c.force_N && c.force_target)
    check(c.name + ": force", relative_error(r.figures.force_N, c.force_N), *c.force_target,
          percent, missed);
  const auto mm = [](double length) { return std::to_string(length) + " mm"; };
  if (c.length_target_mm)
    for (const Quantity& q : kLengths)
      if (const Expected& expected = c.*q.expected)
        check(c.name + ": " + q.key, r.figures.*q.found - *expected, *c.length_target_mm, mm,
              missed);
  if (c.half_width_middle_mm && c.radial_strain_target)
    check(c.name + ": radial strain",
          (r.figures.half_width_middle_mm - *c.half_width_middle_mm) /
              (*c.half_width_middle_mm - c.radius_mm()),
          *c.radial_strain_target, percent, missed);
  return missed;
}

}  // namespace mammotwin
