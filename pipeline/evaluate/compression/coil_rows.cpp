#include "pipeline/evaluate/compression/coil_rows.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/evaluate/cases/breast_inputs.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/breast_stages.h"
#include "pipeline/frame/products.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/pressed_sides.h"
#include "pipeline/synthesize/coil_pressed.h"
#include "pipeline/synthesize/hanging_truth.h"
#include "pipeline/synthesize/nrrd_file.h"
#include "registration/carry/point_carrier.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kImagedScan =
    "scan.nrrd";  // `segment` leaves its part of the MRI in mri.nrrd
const char* const kViews[] = {"cc", "mlo"};

BreastToPress breast_in(const fs::path& folder) {
  fs::create_directories(folder);
  return {folder.filename(), folder / "patient.toml", folder};
}

/// What is true of one breast, and its MRI between the plates.
struct CoilTruth {
  SyntheticPatient imaged;
  HermiteMesh pressed{{}, {}}, unloaded{{}, {}};
  double force_N = 0;
  double roundness = 0;  ///< free of load
};

std::string views_toml(const BreastToPress& truth) {
  std::ostringstream toml;
  for (const char* view : kViews)
    toml << "[views." << view << "]\nthickness_mm = "
         << stage_sidecar(truth.folder / (std::string(view) + ".vtu"))
                .at("quality")
                .at("thickness_mm")
         << "\n";
  return toml.str();
}

CoilTruth make_truth(const CoilCase& asked, const BreastToPress& breast) {
  const SyntheticBreast drawn = draw_breast(asked.number);
  CoilTruth truth;
  SyntheticPatient patient = make_drawn(drawn, true);
  const Eigen::Vector3i n = kTruthElements;
  write_text_atomically(breast.patient_toml,
                        "side = \"" + std::string(name_of(patient.truth.region.side)) +
                            "\"\nfit.elements = [" + std::to_string(n.x()) + ", " +
                            std::to_string(n.y()) + ", " + std::to_string(n.z()) + "]\n");
  segment_drawn(drawn, breast.folder);
  const BreastStages stages(breast, true);
  const fs::path prone = breast.folder / "prone.vtu", unloaded = breast.folder / "unloaded.vtu";
  stages.fit(prone);
  stages.unload(prone, unloaded);
  for (const std::string view : kViews)
    stages.press(view, unloaded, breast.folder / (view + ".vtu"));

  const MeshFile file = read_mesh_file(unloaded);
  const Segmentation segmentation =
      read_segmentation(stages.segmentation(), fractions_beside(stages.segmentation()));
  Patient settings;
  settings.read(breast.patient_toml);
  CompressionProblem hanging{
      breast_problem(file, tissue_of(file, segmentation.fractions), settings.compression,
                     stiffness_factor_of(file, settings.compression)),
      {},
      {}};
  hanging.gravity = gravity_in_lps(Pose::prone);
  hanging.density = settings.gravity.density();
  hanging.friction = settings.compression.friction;
  truth.pressed = prone_file(file).mesh;
  truth.unloaded = file.mesh;
  if (asked.pressed > 0) {
    const CompressionResult result =
        press_between_coil_plates(hanging, settings.compression, asked.pressed);
    truth.pressed = HermiteMesh(result.deformed, file.mesh.elements());
    truth.force_N = result.report.force_N;
  }
  MeshFile shown = file;
  shown.mesh = truth.pressed;
  truth.roundness = Roundness(shown, Eigen::Vector3d::UnitX()).of(truth.unloaded.nodes());
  truth.imaged = imaged_pressed(std::move(patient), prone_file(file).mesh, truth.pressed);
  return truth;
}

void write_imaged(const CoilTruth& truth, const BreastToPress& imaged,
                  const BreastToPress& true_breast) {
  write_nrrd(imaged.folder / kImagedScan, truth.imaged.scan.image);
  std::ostringstream toml;
  toml << "side = \"" << name_of(truth.imaged.truth.region.side) << "\"\n[mri]\npath = \""
       << kImagedScan << "\"\n";
  for (const Lesion& lesion : truth.imaged.truth.lesions) {
    const Eigen::Vector3d& at = lesion.centroid_in_lps;
    toml << "[[lesions]]\nid = \"" << lesion.id << "\"\npoint_lps_mm = [" << at.x() << ", "
         << at.y() << ", " << at.z() << "]\n";
  }
  write_text_atomically(imaged.patient_toml, toml.str() + views_toml(true_breast));
}

/// Root mean square distance of the unloaded skin from where it truly is [mm].
double shape_rms(const fs::path& unloaded, const CoilTruth& truth) {
  constexpr int kSamples = 4;
  constexpr double kSameSkin_mm = 3;
  const MeshFile file = read_mesh_file(unloaded);
  const HermiteMesh imaged = prone_file(file).mesh;
  const PointCarrier truly(truth.pressed, truth.unloaded);
  double sum = 0;
  int count = 0;
  for (int e = 0; e < file.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      for (int k = 0; file.faces[e][face] == FaceLabel::skin && k < kSamples * kSamples; ++k) {
        const MeshPoint point{e, point_on_face(face, (k % kSamples + 0.5) / kSamples,
                                               (k / kSamples + 0.5) / kSamples)};
        const CarriedPoint there = truly.carry(imaged.position(point));
        if (there.outside_mm > kSameSkin_mm) continue;  // the two regions do not end alike
        sum += (file.mesh.position(point) - there.in_lps).squaredNorm();
        ++count;
      }
  return std::sqrt(sum / count);
}

/// The largest distance of a lesion from where it truly comes to lie, relative to the nipple [mm].
double lesion_off(const std::string& view, const fs::path& pressed, const BreastStages& imaged,
                  const BreastStages& stages) {
  const PressedPlaces found(pressed, view, imaged.segmentation());
  const PressedPlaces truly(stages.breast().folder / (view + ".vtu"), view, stages.segmentation());
  const auto lesions = [&](const BreastStages& of) {
    return read_segmentation(of.segmentation(), fractions_beside(of.segmentation())).lesions;
  };
  const std::vector<Lesion> there = lesions(imaged), here = lesions(stages);
  double worst = 0;
  for (std::size_t n = 0; n < std::min(there.size(), here.size()); ++n)
    worst = std::max(
        worst,
        (found.of(there[n].centroid_in_lps) - truly.of(here[n].centroid_in_lps)).head<2>().norm());
  return worst;
}

json new_coil_row(const CoilCase& asked) {
  json row{{"name", draw_breast(asked.number).name}};
  for (const char* key : {"volume_ml", "asked_roundness", "true_roundness", "imaged_roundness",
                          "roundness", "plates_N", "found_N", "shape_rms_mm", "lesion_cc_mm",
                          "lesion_mlo_mm", "stiffened", "reason"})
    row[key] = nullptr;
  return row;
}

/// What comes of one roundness; the files carry its number in their names.
void let_go(double roundness, const CoilTruth& truth, const BreastStages& imaged,
            const BreastStages& stages, json& row) {
  row["asked_roundness"] = roundness;
  const fs::path& folder = imaged.breast().folder;
  const std::string number = json(roundness).dump();
  const fs::path unloaded = folder / ("unloaded_" + number + ".vtu");
  imaged.unload(folder / "prone.vtu", unloaded, {"--coil-roundness", number});
  const json quality = stage_sidecar(unloaded).at("quality");
  row["stiffened"] = quality.at("stiffened");
  if (const json& coil = quality.at("coil"); !coil.is_null()) {
    row["imaged_roundness"] = coil.at("roundness_imaged");
    row["roundness"] = coil.at("roundness");
    row["found_N"] = coil.at("force_N");
  }
  row["shape_rms_mm"] = shape_rms(unloaded, truth);
  for (const std::string view : kViews) {
    const fs::path pressed = folder / (view + "_" + number + ".vtu");
    imaged.press(view, unloaded, pressed);
    row["lesion_" + view + "_mm"] = lesion_off(view, pressed, imaged, stages);
  }
}

}  // namespace

void add_coil_rows(const CoilCase& asked, const std::function<void(const json&)>& add) {
  json row = new_coil_row(asked);
  try {
    const BreastToPress true_breast = breast_in(asked.folder / "truth"),
                        imaged_breast = breast_in(asked.folder / "imaged");
    const CoilTruth truth = make_truth(asked, true_breast);
    write_imaged(truth, imaged_breast, true_breast);
    row["volume_ml"] = truth.imaged.truth.breast_ml;
    row["plates_N"] = truth.force_N;
    row["true_roundness"] = truth.roundness;
    const BreastStages stages(true_breast, true), imaged(imaged_breast);
    imaged.fit(imaged_breast.folder / "prone.vtu");
    for (const double roundness : asked.roundnesses) {
      json one = row;
      try {
        let_go(roundness, truth, imaged, stages, one);
      } catch (const std::exception& error) {
        one["reason"] = error.what();
      }
      add(one);
    }
  } catch (const std::exception& error) {
    row["reason"] = error.what();
    add(row);
  }
}

}  // namespace mammotwin
