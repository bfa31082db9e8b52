#include "pipeline/validation/gel_case.h"

#include <stdexcept>

#include "pipeline/frame/nearest_name.h"
#include "pipeline/frame/settings.h"
#include "pipeline/frame/toml_file.h"

namespace mammotwin {

namespace {

void assign(Settings& settings, const std::string& file, const std::string& key,
            const nlohmann::json& value) {
  if (!settings.find(key))
    throw std::runtime_error(file + ": " + key + " is not known; did you mean " +
                             nearest_name(key, settings.keys()) + "?");
  settings.assign(file + ": " + key, key, value);
}

/// The mesh of an eighth, in its own counts; CylinderElements counts the whole cross-section.
void declare_mesh(Settings& s, const std::string& prefix, CylinderElements& e) {
  s.integer(prefix + "square", e.square, {1, 20}, "elements along half the square's side");
  s.integer(prefix + "ring", e.ring, {1, 20}, "elements between the square and the mantle");
  s.integer(prefix + "length", e.length, {1, 40}, "elements along half the length");
  s.number(prefix + "ring_grading", e.ring_grading, {0.01, 100},
           "size at the mantle / at the square");
  s.number(prefix + "length_grading", e.length_grading, {0.01, 100},
           "size at the end / in the middle");
}

void declare(Settings& s, GelCase& c) {
  CylinderExperiment& x = c.experiment;
  s.choice("case", x.how,
           {{"lateral", CylinderCase::lateral},
            {"plane_strain", CylinderCase::plane_strain},
            {"axial", CylinderCase::axial},
            {"bonded", CylinderCase::bonded}},
           "how the cylinder is squeezed");
  s.number("diameter_mm", x.diameter, {1, 1000, "mm"}, "of the cylinder");
  s.number("length_mm", x.length, {1, 1000, "mm"}, "of the cylinder");
  s.number("c1_kpa", x.c1, {0.001, 1000, "kPa"}, "half the shear modulus");
  s.number("thickness_mm", x.thickness, {0.1, 1000, "mm"}, "between the plates in the end");
  s.number("gap_tolerance_mm", x.gap_tolerance, {0, 1, "mm"}, "largest penetration");
  s.integer("curve_steps", c.curve_steps, {0, 100}, "load steps of the force-thickness curve");
  s.flag("as_the_paper_ran_it", c.as_the_paper_ran_it, "also half a cylinder and one plate");
  declare_mesh(s, "mesh.", x.elements);
  const Range length{0, 1000, "mm"}, force{0, 1e6, "N"}, fraction{0, 1};
  s.number("reference.force_N", c.force_N, force, "of the whole cylinder");
  s.number("reference.force_error_N", c.force_error_N, force, "how well it is known");
  s.number("reference.half_width_middle_mm", c.half_width_middle_mm, length, "at half length");
  s.number("reference.half_width_end_mm", c.half_width_end_mm, length, "at the end");
  s.number("reference.half_length_axis_mm", c.half_length_axis_mm, length, "on the axis");
  s.number("target.force", c.force_target, fraction, "relative error allowed");
  s.number("target.length_mm", c.length_target_mm, length, "error allowed");
  s.number("target.radial_strain", c.radial_strain_target, fraction, "relative error allowed");
}

/// A table's keys into the variables that `declare_entry` binds.
template <class Entry, class Declare>
std::vector<Entry> read_list(const std::string& where, const nlohmann::json& list,
                             Declare declare_entry) {
  std::vector<Entry> entries;
  if (!list.is_array()) throw std::runtime_error(where + ": expected a list of tables");
  for (const auto& table : list) {
    Entry& entry = entries.emplace_back();
    Settings settings;
    declare_entry(settings, entry);
    for (const auto& [key, value] : table.items()) assign(settings, where, key, value);
  }
  return entries;
}

void declare_curve(Settings& s, GelCurvePoint& p) {
  s.number("thickness_mm", p.thickness_mm, {0.1, 1000, "mm"}, "between the plates");
  s.number("force_N", p.force_N, {0, 1e6, "N"}, "of the whole cylinder");
  s.number("half_width_middle_mm", p.half_width_middle_mm, {0, 1000, "mm"}, "at half length");
}

}  // namespace

GelCase read_gel_case(const std::filesystem::path& file) {
  GelCase c;
  c.name = file.stem().string();
  c.experiment.elements = {1, 1, 1};
  Settings settings;
  declare(settings, c);
  for (const auto& [key, value] : read_toml(file)) {
    const std::string where = file.string() + ": " + key;
    if (key == "curve")
      c.curve = read_list<GelCurvePoint>(where, value, declare_curve);
    else if (key == "study")
      c.study = read_list<CylinderElements>(
          where, value, [](Settings& s, CylinderElements& e) { declare_mesh(s, "", e); });
    else
      assign(settings, file.string(), key, value);
  }
  c.experiment.elements.square *= 2;
  for (CylinderElements& e : c.study) e.square *= 2;
  return c;
}

}  // namespace mammotwin
