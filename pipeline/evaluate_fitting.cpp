// evaluate-fitting: fits every breast of a folder of cases, unattended -> one table.

#include "fitting/fit_breast.h"
#include "fitting/tissue_volumes.h"
#include "pipeline/evaluate/label_maps.h"
#include "pipeline/fit_quality.h"
#include "pipeline/frame/process.h"
#include "pipeline/frame/products.h"
#include "segmentation/mean_fractions.h"
#include "segmentation/segment.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <iostream>

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path cases, table;
  std::string only;
  FitOptions fit;
};

void declare(CLI::App& app, Arguments& args) {
  app.add_option("cases", args.cases, "folder with label_maps/*.nii.gz and mimbcd_*/mri")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("table", args.table, "fitting.json to write")->required();
  app.add_option("--only", args.only, "cases whose name contains this (text)");
  app.add_option("--elements", args.fit.elements[0], "along x and z [1 to 16]")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  app.add_option("--shape", args.fit.shape, "weight of the elements' shape [0.1 to 10]")
      ->check(CLI::Range(0.1, 10.0))
      ->capture_default_str();
}

struct Case {
  std::string name;
  SegmentInput input;
};

std::vector<Case> label_map_cases(const std::filesystem::path& cases) {
  std::vector<Case> found;
  for (const LabelMapBreast& breast : label_map_breasts(cases)) {
    Case& c = found.emplace_back(Case{breast.exam, {}});
    c.input.label_map = breast.file;
    c.input.label_values = label_map_values();
    c.input.side = breast.side;
  }
  return found;
}

std::vector<Case> mri_cases(const std::filesystem::path& cases) {
  std::vector<Case> found;
  for (const auto& folder : sorted_entries(cases)) {
    if (!folder.filename().string().starts_with("mimbcd_")) continue;
    const auto radiologist = nlohmann::json::parse(std::ifstream(folder / "lesions_radiologist.json"));
    Case c{folder.filename().string(), {}};
    c.input.mri = folder / "mri";
    const auto& lesion = radiologist.at("mri").at(0);
    const auto& x = lesion.at("centroid_lps_mm");
    LesionSeed& seed = c.input.lesions.emplace_back();
    seed.id = "1";
    seed.point_in_lps = Eigen::Vector3d(x[0], x[1], x[2]);
    c.input.side = lesion.at("side") == "L" ? Side::left : Side::right;
    found.push_back(c);
  }
  return found;
}

nlohmann::json relative_error(double found, double expected) {
  if (expected < 1) return nullptr;  // [ml]: too little to be a fraction of
  return found / expected - 1;
}

void add_tissue(nlohmann::json& row, const HermiteMesh& mesh, const Segmentation& s) {
  const MeanFractions mean(s.fractions);
  const TissueVolumes voxels = tissue_in_voxels(s);
  const TissueVolumes in_mesh = tissue_in_mesh(
      mesh, [&](const Eigen::Vector3d& x, double volume) { return mean.at(x, volume); });
  row["volume_error"] = relative_error(in_mesh.total(), voxels.total());
  row["fat_volume_error"] = relative_error(in_mesh.fat, voxels.fat);
  row["fibroglandular_volume_error"] =
      relative_error(in_mesh.fibroglandular, voxels.fibroglandular);
  row["lesion_volume_error"] = relative_error(in_mesh.lesion, voxels.lesion);
}

/// A failed case stays in the table with its reason.
nlohmann::json evaluate(const Case& c, const FitOptions& options) {
  nlohmann::json row = {{"name", c.name}, {"side", to_string(*c.input.side)}, {"reason", nullptr}};
  try {
    const Segmentation s = segment(c.input, {}).segmentation;
    const auto start = std::chrono::steady_clock::now();
    const FitResult fit = fit_breast(s, options);
    row["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Outcome outcome = judge_fit(fit.report);
    row.update(outcome.quality);
    row["status"] = name_of(outcome.status);
    row["reasons"] = outcome.reasons;
    if (fit.report.usable())
      add_tissue(row, fit.mesh.mesh, s);
    else
      row["reason"] = fit.report.reasons.front();
  } catch (const std::exception& error) {
    row["status"] = "refused";
    row["reason"] = error.what();
  }
  return row;
}

void say(const nlohmann::json& row) {
  std::cerr << row["name"].get<std::string>() << " " << row["side"].get<std::string>() << ": "
            << row["status"].get<std::string>();
  for (const char* key : {"skin_rms_mesh_to_data_mm", "skin_rms_data_to_mesh_mm", "skin_p95_mm",
                          "skin_max_mm", "nipple_error_mm", "chest_wall_rms_mm", "min_scaled_jacobian",
                          "covered_fraction", "seconds"})
    if (row.contains(key)) std::cerr << "  " << key << " " << row[key];
  if (!row["reason"].is_null()) std::cerr << "  " << row["reason"].get<std::string>();
  std::cerr << std::endl;
}

int run(const Arguments& args) {
  std::vector<Case> all = label_map_cases(args.cases);
  for (const Case& c : mri_cases(args.cases)) all.push_back(c);
  nlohmann::json rows = nlohmann::json::array();
  for (const Case& c : all) {
    if (c.name.find(args.only) == std::string::npos) continue;
    rows.push_back(evaluate(c, args.fit));
    say(rows.back());
  }
  if (rows.empty()) {
    std::cerr << args.cases.string() << ": no label_maps/*_labels.nii.gz and no mimbcd_* in it"
              << std::endl;
    return 1;
  }
  std::filesystem::create_directories(std::filesystem::absolute(args.table).parent_path());
  write_text_atomically(args.table, nlohmann::json{{"cases", rows}}.dump(1) + "\n");
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  mammotwin::prepare_process(argv);
  CLI::App app("Fits every breast of a folder of cases and writes the figures of each");
  mammotwin::Arguments args;
  mammotwin::declare(app, args);
  try {
    app.parse(argc, argv);
    args.fit.elements[1] = args.fit.elements[0];
    return mammotwin::run(args);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) ? 2 : 0;
  } catch (const std::exception& error) {
    std::cerr << "evaluate-fitting: " << error.what() << std::endl;
    return 1;
  }
}
