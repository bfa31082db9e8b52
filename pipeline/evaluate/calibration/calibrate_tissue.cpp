// calibrate-tissue: finds the numbers of the tissue with which breasts do what women's do -> a
// table.

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/evaluate/calibration/tissue_calibration.h"
#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/compression/breast_stages.h"
#include "pipeline/evaluate/compression/typical_press.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path cases, table;
  std::vector<std::string> only;
  std::vector<std::string> numbers{"materials.stiffness_factor", "materials.*.stiffening",
                                   "materials.*.most_stiffening"};
  std::string preset = "real", elements = "5x5x2";
  int jobs = 2;
};

void declare(CommandLine& command, Arguments& args) {
  declare_cases(command, args.cases);
  declare_table(command, args.table, "tissue_calibration");
  declare_only(command, args.only);
  command.option(
      "--numbers", args.numbers,
      "settings to find (default: materials.stiffness_factor, materials.*.stiffening, "
      "materials.*.most_stiffening); also "
      "materials.skin.c1_kpa, compress.chest_wall_spring_kpa_per_mm, compress.cut_face_depth_mm");
  command.option("--preset", args.preset, "materials.preset to start from").with_default();
  command.option("--elements", args.elements, "of each breast's mesh").with_default();
  declare_jobs(command, args.jobs);
}

/// Segmented, fitted and pressed with the numbers that the calibration starts from, in a folder of
/// its name: to what is typical of the volume that then is in front of the plates' edge.
CalibratedBreast prepared(const RealBreast& breast, const Arguments& args,
                          const OutlinePopulation& population, const fs::path& folder) {
  fs::create_directories(folder);
  const BreastToPress files{name_and_side(breast), folder / "patient.toml", folder};
  write_text_atomically(files.patient_toml, patient_toml_of(breast));
  const BreastStages stages(files);
  stages.fit(folder / "prone.vtu", elements_options(args.elements));
  stages.unload(folder / "prone.vtu", folder / "unloaded.vtu");
  json plates{{"reason", nullptr}};
  add_plates(folder, population, plates);
  if (!plates.at("thickness_mm").is_number())
    throw std::runtime_error(files.name + ": " + plates.at("reason").dump());
  write_text_atomically(files.patient_toml, patient_toml_of(breast) +
                                                "[views.cc]\nthickness_mm = " +
                                                plates.at("thickness_mm").dump() + "\n");
  return CalibratedBreast(folder);
}

json moves_json(const double* figures) {
  return {{"lateral_mm", figures[kLateral]},
          {"posterior_mm", figures[kPosterior]},
          {"landmark_mm", figures[kLandmark]},
          {"ribs_mm", figures[kRibs]}};
}

json breast_json(const CalibratedBreast& breast, const BreastFigures& figures) {
  json line = moves_json(figures.data());
  line["thickness_mm"] = breast.thickness_mm();
  line["force_N"] = std::exp(figures[kLogForce]);
  return line;
}

json population_json(const PopulationMeans& figures) {
  json line = moves_json(figures.data());
  line["force_of_thin_N"] = std::exp(figures[kLogForceOfThin]);
  line["force_of_thick_N"] = std::exp(figures[kLogForceOfThick]);
  return line;
}

/// Changes of figures: a logarithm's is a part of the force.
json changes_json(const PopulationMeans& changes) {
  json line = moves_json(changes.data());
  line["force_of_thin_percent"] = 100 * changes[kLogForceOfThin];
  line["force_of_thick_percent"] = 100 * changes[kLogForceOfThick];
  return line;
}

json number_json(const CalibratedNumber& n) {
  json line{{"kind", "number"}, {"name", n.number.key}, {"unit", n.number.unit}, {"start", n.start},
            {"value", n.value}, {"low_95", nullptr},    {"high_95", nullptr}};
  if (n.low) line["low_95"] = *n.low;
  if (n.high) line["high_95"] = *n.high;
  line.update(changes_json(n.slopes));
  return line;
}

void write_rows(const Calibration& found, const std::vector<CalibratedBreast>& breasts,
                const CalibrationData& data, EvaluationTable& table) {
  std::size_t row = 0;
  const auto add = [&](const std::string& kind, const std::string& name, const json& figures) {
    json line{{"kind", kind}, {"name", name}};
    line.update(figures);
    table.add(row++, std::move(line));
  };
  for (const CalibratedNumber& number : found.numbers) table.add(row++, number_json(number));
  PopulationMeans target{}, sd{};
  for (int i = 0; i < kPopulationMeans; ++i) target[i] = data[i].target, sd[i] = data[i].sd;
  add("population", "women, usual forces", population_json(target));
  add("population", "standard deviation of that", changes_json(sd));
  add("population", "at the start", population_json(found.start));
  add("population", "calibrated", population_json(found.end));
  for (std::size_t b = 0; b < breasts.size(); ++b)
    add("breast", breasts[b].name(), breast_json(breasts[b], found.breasts[b]));
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  const auto say = [](const std::string& line) { std::cerr << line << std::endl; };
  const OutlinePopulation population(args.cases / "compressed_outlines");
  std::vector<CalibratedBreast> breasts;
  std::set<std::string> persons;
  for (RealBreast& breast : asked_breasts(args.cases, args.only)) {
    if (!breast.is_label_map) continue;
    breast.preset = args.preset;
    breasts.push_back(prepared(breast, args, population,
                               table.folder() / "tissue_calibration" / name_and_side(breast)));
    persons.insert(breast.name);
    say(name_and_side(breast) + ": fitted, and pressed once");
  }
  if (breasts.empty()) throw std::runtime_error(args.cases.string() + ": no such label map in it");
  const auto data = calibration_data(read_womens_moves(args.cases / "prone_supine" / "points.csv"),
                                     static_cast<int>(persons.size()));
  const Calibration found =
      calibrate_tissue(breasts, tissue_numbers(args.numbers), data, args.jobs, say);
  write_rows(found, breasts, data, table);
  say(found.ended);
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "calibrate-tissue",
      "Finds the numbers of the tissue with which breasts, unloaded, laid on their backs and "
      "pressed, do what women's do",
      declare, run);
}
