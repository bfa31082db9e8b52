#include "pipeline/validation/gel_table.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace mammotwin {

namespace {

std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char* pattern, ...) {
  char text[256];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

std::string percent(double fraction, int width) {
  return std::isnan(fraction) ? format("%*s", width, "-") : format("%*.3f", width, 100 * fraction);
}

std::string millimetres(double found, const std::optional<double>& expected) {
  return format("%9.3f ", found) + (expected ? format("%+7.3f", found - *expected) : "      -");
}

std::string row(const GelCase& c, const CylinderFigures& f, const char* name) {
  const auto& width = c.half_width_middle_mm;
  const double strain = f.half_width_middle_mm / c.radius_mm() - 1;
  const double strain_error = width ? strain / (*width / c.radius_mm() - 1) - 1 : std::nan("");
  return format("%-12s %6d %9.4f ", name, f.dof, f.force_N) +
         percent(relative_error(f.force_N, c.force_N), 7) + " " +
         millimetres(f.half_width_middle_mm, width) + " " +
         millimetres(f.half_width_end_mm, c.half_width_end_mm) + " " +
         millimetres(f.half_length_axis_mm, c.half_length_axis_mm) + format(" %8.5f ", strain) +
         percent(strain_error, 7) +
         format(" %8.5f %4d %7.2f%s\n", f.penetration_mm, f.iterations, f.cpu_seconds,
                f.usable ? "" : "  not converged");
}

std::string expected_row(const GelCase& c) {
  const auto value = [](const std::optional<double>& x, const char* pattern, int width) {
    char text[32];
    std::snprintf(text, sizeof text, pattern, x.value_or(0));
    return format("%*s", width, x ? text : "-");
  };
  std::optional<double> strain;
  if (c.half_width_middle_mm) strain = *c.half_width_middle_mm / c.radius_mm() - 1;
  return format("%-12s %6s ", "other codes", "") + value(c.force_N, "%.4f", 9) +
         format(" %7s ", "") + value(c.half_width_middle_mm, "%.3f", 9) + format(" %7s ", "") +
         value(c.half_width_end_mm, "%.3f", 9) + format(" %7s ", "") +
         value(c.half_length_axis_mm, "%.3f", 9) + format(" %7s ", "") + value(strain, "%.5f", 8) +
         "\n";
}

std::string curve_rows(const GelResult& r) {
  std::string text = "  thickness      force  others      %  half width  others   mm\n";
  const nlohmann::json rows = to_json(r)["curve"];
  for (const auto& entry : rows) {
    text += format("  %6.2f mm %8.4f N", entry["thickness_mm"].get<double>(),
                   entry["force_N"].get<double>());
    const auto& reference = entry["reference"];
    if (reference["force_N"].is_number())
      text += format(" %7.4f %+6.2f", reference["force_N"].get<double>(),
                     100 * entry["relative_error"]["force_N"].get<double>());
    if (reference["half_width_middle_mm"].is_number()) {
      const double expected = reference["half_width_middle_mm"];
      const double found = entry["half_width_middle_mm"];
      text += format("  %9.3f %8.3f %+6.3f", found, expected, found - expected);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string gel_table(const GelResult& r) {
  const GelCase& c = r.experiment;
  std::string text =
      c.name + format(", %g mm between the plates\n", c.experiment.thickness) +
      "             unknowns  force N  err %  half width      mm half w. end      mm half length"
      "      mm   strain  err %    gap mm its   CPU s\n";
  text += expected_row(c);
  for (const CylinderFigures& f : r.study) text += row(c, f, "");
  text += row(c, r.figures, "recommended");
  if (r.half) text += row(c, *r.half, "half, 1 plate");
  if (!r.curve.empty()) text += curve_rows(r);
  return text;
}

}  // namespace mammotwin
