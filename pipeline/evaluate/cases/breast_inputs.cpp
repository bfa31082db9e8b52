#include "pipeline/evaluate/cases/breast_inputs.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/frame/products.h"
#include "pipeline/patient/compression_settings.h"
#include "pipeline/synthesize/option_table.h"
#include "pipeline/synthesize/patient.h"
#include "registration/view/plate_turn.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kPatientThicknessMm = 55;
constexpr double kPatientMloDeg = 45;
constexpr int kMostAttempts = 30;  // of the drawn build

json read_json(const fs::path& path) {
  std::ifstream in(path);
  return in ? json::parse(in) : json();
}

/// All that segmentation and mesh depend on.
json made_from(const EvaluatedBreast& breast) {
  if (breast.label_map)
    return {{"label_map", breast.label_map->exam}, {"side", name_of(breast.label_map->side)}};
  const PatientOptions& drawn = breast.synthetic->patient;
  json options{{"seed", drawn.anatomy.seed}, {"side", name_of(drawn.anatomy.side)}};
  visit_numbers(drawn, [&](const char* name, const auto& value, double, double, const char*,
                           const char*) { options[name] = value; });
  return options;
}

/// Runs a stage whose product lies in `folder` and returns its sidecar. Throws std::runtime_error
/// with its reason where it left no product.
json run_stage_in(const fs::path& folder, const std::string& stage,
                  const std::vector<std::string>& arguments, const std::string& product) {
  const StageEnd end =
      run_stage_command(stage, arguments, folder / (stage + ".log"), kMostStageCpuSeconds);
  const json sidecar = read_json(folder / (product + ".json"));
  if (end.exit_code == 0) return sidecar;
  const json reasons = sidecar.value("reasons", json::array());
  throw std::runtime_error(stage + ": " +
                           (reasons.empty() ? "ended with code " + std::to_string(end.exit_code)
                                            : reasons.front().get<std::string>()));
}

json segment_label_map(const LabelMapBreast& breast, const fs::path& folder) {
  write_text_atomically(folder / "patient.toml", side_toml(breast.side) + labels_toml(breast.file));
  const json sidecar = run_stage_in(folder, "segment",
                                    {(folder / "segmentation.seg.nrrd").string(), "--patient",
                                     (folder / "patient.toml").string()},
                                    "segmentation.seg.nrrd");
  const json& q = sidecar.at("quality");
  return {{"side", name_of(breast.side)},
          {"volume_ml", q.at("breast_volume_ml")},
          {"density",
           q.at("fibroglandular_ml").get<double>() / q.at("breast_volume_ml").get<double>()}};
}

json fit(const fs::path& folder) {
  const auto file = [&](const char* name) { return (folder / name).string(); };
  const json sidecar = run_stage_in(
      folder, "fit", {file("segmentation.seg.nrrd"), file("fractions.nrrd"), file("prone.vtu")},
      "prone.vtu");
  return {{"fit_status", sidecar.at("status")},
          {"fit_skin_rms_mm", sidecar.at("quality").at("skin_rms_mesh_to_data_mm")},
          {"fit_seconds", sidecar.at("seconds")}};
}

/// A breast without a mesh is remembered with its reason.
json make_folder(const EvaluatedBreast& breast) {
  fs::remove_all(breast.folder);
  fs::create_directories(breast.folder);
  json about{{"made_from", made_from(breast)}, {"facts", json::object()}, {"reason", ""}};
  try {
    about["facts"] = breast.synthetic ? segment_drawn(*breast.synthetic, breast.folder)
                                      : segment_label_map(*breast.label_map, breast.folder);
    about["facts"].update(fit(breast.folder));
  } catch (const std::exception& error) {
    about["reason"] = error.what();
  }
  write_text_atomically(breast.folder / "about.json", about.dump(1) + "\n");
  return about;
}

/// As mammotwin-compress places plates by default, but for what gravity changes of their turn.
double free_extent(const MeshFile& mesh, const Segmentation& segmentation, double angle_deg) {
  const Eigen::Matrix3d axes =
      usual_axes(mesh, InverseMap(mesh.mesh).nearest(segmentation.nipple_in_lps),
                 segmentation.region.side, angle_deg);
  PlateOptions plates;
  plates.depth = axes.row(0);
  plates.up = axes.row(2);
  return free_thickness(mesh, plates);
}

void ask(const EvaluatedBreast& breast, PreparedBreast& prepared) {
  const MeshFile mesh = read_mesh_file(breast.folder / "prone.vtu");
  const Segmentation segmentation =
      read_segmentation(breast.folder / "segmentation.seg.nrrd", breast.folder / "fractions.nrrd");
  auto& [cc, mlo] = prepared.views;
  mlo.angle_deg = breast.synthetic ? breast.synthetic->patient.views.mlo_angle_deg : kPatientMloDeg;
  for (AskedView& view : prepared.views) {
    view.free_thickness_mm = free_extent(mesh, segmentation, view.angle_deg);
    view.thickness_mm = kPatientThicknessMm;
  }
  if (!breast.synthetic) return;
  cc.thickness_mm = (1 - breast.synthetic->cc_fraction) * cc.free_thickness_mm;
  mlo.thickness_mm = (1 - breast.synthetic->mlo_fraction) * mlo.free_thickness_mm;
}

void write_toml(const EvaluatedBreast& breast, const PreparedBreast& prepared) {
  std::ostringstream toml;
  toml << "side = " << prepared.facts.at("side") << "\n";
  if (breast.label_map) toml << labels_toml(breast.label_map->file);
  toml << "[materials]\npreset = \"" << breast.preset << "\"\n";
  if (breast.synthetic) {
    const CompressionSettings defaults;
    const double gland = breast.synthetic->stiffness_ratio * defaults.fat.c1_kpa;
    toml << "fibroglandular.c1_kpa = " << gland
         << "\nlesion.c1_kpa = " << gland * defaults.lesion.c1_kpa / defaults.fibroglandular.c1_kpa
         << "\n";
  }
  for (const AskedView& view : prepared.views)
    toml << "[views." << view.view << "]\nthickness_mm = " << view.thickness_mm
         << "\nangle_deg = " << view.angle_deg << "\n";
  write_text_atomically(breast.folder / "patient.toml", toml.str());
}

/// A breast that no shape free of load is found of has that for its reason.
void take_gravity_off(const EvaluatedBreast& breast, PreparedBreast& prepared) {
  const auto file = [&](const char* name) { return (breast.folder / name).string(); };
  try {
    const json sidecar =
        run_stage_in(breast.folder, "unload",
                     {file("segmentation.seg.nrrd"), file("fractions.nrrd"), file("prone.vtu"),
                      file("unloaded.vtu"), "--patient", file("patient.toml")},
                     "unloaded.vtu");
    prepared.facts["unload_status"] = sidecar.at("status");
    prepared.facts["unload_seconds"] = sidecar.at("seconds");
  } catch (const std::exception& error) {
    prepared.facts["unload_status"] = "refused";
    prepared.reason = error.what();
  }
}

}  // namespace

SyntheticPatient make_drawn(const SyntheticBreast& drawn, bool scanned) {
  for (int attempt = 0;; ++attempt) {
    try {
      const PatientOptions options = draw_breast(drawn.number, attempt).patient;
      return scanned ? make_patient(options) : make_patient_without_scan(options);
    } catch (const std::invalid_argument&) {
      if (attempt + 1 == kMostAttempts) throw;
    }
  }
}

json segment_drawn(const SyntheticBreast& drawn, const fs::path& folder) {
  const SyntheticPatient p = make_drawn(drawn, false);
  const Segmentation s = true_segmentation(p.tissue, p.labels, p.truth);
  write_segmentation(folder / "segmentation.seg.nrrd", s);
  write_fractions(folder / "fractions.nrrd", s.fractions);
  return {{"side", name_of(p.truth.region.side)},
          {"volume_ml", p.truth.breast_ml},
          {"density", p.truth.fibroglandular_ml / p.truth.breast_ml},
          {"ptosis", p.options.anatomy.ptosis},
          {"lesions", p.options.anatomy.lesions}};
}

PreparedBreast prepare_breast(const EvaluatedBreast& breast, bool again) {
  json about = read_json(breast.folder / "about.json");
  if (again || about.is_null() || about.at("made_from") != made_from(breast))
    about = make_folder(breast);
  PreparedBreast prepared{about.at("facts"), about.at("reason")};
  if (breast.synthetic) {
    prepared.facts["stiffness_ratio"] = breast.synthetic->stiffness_ratio;
    prepared.facts["hard"] = breast.synthetic->hard;
  }
  if (!prepared.usable()) return prepared;
  ask(breast, prepared);
  write_toml(breast, prepared);
  if (breast.unload) take_gravity_off(breast, prepared);
  return prepared;
}

}  // namespace mammotwin
