#include "pipeline/evaluate/compression/coil_rows.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/evaluate/cases/breast_inputs.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/pressed_places.h"
#include "pipeline/frame/products.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/coil_plates.h"
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
constexpr double kKpaPerNPerCm2 = 10;
const char* const kViews[] = {"cc", "mlo"};

/// A breast under way through the stages, in its folder.
class CoilStages {
 public:
  explicit CoilStages(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directories(folder_);
  }
  fs::path file(const std::string& name) const { return folder_ / name; }

  double run(const std::string& stage, const std::string& product,
             std::vector<std::string> options = {}) const {
    std::vector<std::string> inputs;
    if (stage != "segment")
      inputs = {file("segmentation.seg.nrrd").string(), file("fractions.nrrd").string()};
    if (stage == "unload") inputs.push_back(file("prone.vtu").string());
    return run_to_product({stage, inputs, file(product), file("patient.toml"), std::move(options)});
  }

  void press(const std::string& view, const std::string& unloaded,
             const std::string& product) const {
    run_to_product({"compress",
                    {view, file("segmentation.seg.nrrd").string(), file("fractions.nrrd").string(),
                     file(unloaded).string()},
                    file(product),
                    file("patient.toml")});
  }

 private:
  fs::path folder_;
};

/// What is true of one breast, and its MRI between the plates.
struct CoilTruth {
  SyntheticPatient imaged;
  HermiteMesh pressed{{}, {}}, unloaded{{}, {}};
  double force_N = 0, area_cm2 = 0;
};

std::string views_toml(const CoilStages& truth) {
  std::ostringstream toml;
  for (const char* view : kViews)
    toml << "[views." << view << "]\nthickness_mm = "
         << stage_sidecar(truth.file(std::string(view) + ".vtu")).at("quality").at("thickness_mm")
         << "\n";
  return toml.str();
}

CoilTruth make_truth(const CoilCase& asked, const CoilStages& stages) {
  const SyntheticBreast drawn = draw_breast(asked.number);
  CoilTruth truth;
  SyntheticPatient patient = make_drawn(drawn, true);
  const Eigen::Vector3i n = kTruthElements;
  write_text_atomically(stages.file("patient.toml"),
                        "side = \"" + std::string(name_of(patient.truth.region.side)) +
                            "\"\nfit.elements = [" + std::to_string(n.x()) + ", " +
                            std::to_string(n.y()) + ", " + std::to_string(n.z()) + "]\n");
  segment_drawn(drawn, stages.file(""));
  stages.run("fit", "prone.vtu");
  stages.run("unload", "unloaded.vtu");
  for (const char* view : kViews) stages.press(view, "unloaded.vtu", std::string(view) + ".vtu");

  const MeshFile file = read_mesh_file(stages.file("unloaded.vtu"));
  const Segmentation segmentation =
      read_segmentation(stages.file("segmentation.seg.nrrd"), stages.file("fractions.nrrd"));
  Patient settings;
  Settings table;
  settings.declare(table);
  settings.read(stages.file("patient.toml"), table);
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
    truth.area_cm2 = result.report.contact_area_cm2;
  }
  truth.imaged = imaged_pressed(std::move(patient), prone_file(file).mesh, truth.pressed);
  return truth;
}

void write_imaged(const CoilTruth& truth, const CoilStages& imaged, const CoilStages& stages) {
  write_nrrd(imaged.file(kImagedScan), truth.imaged.scan.image);
  std::ostringstream toml;
  toml << "side = \"" << name_of(truth.imaged.truth.region.side) << "\"\n[mri]\npath = \""
       << kImagedScan << "\"\n";
  for (const Lesion& lesion : truth.imaged.truth.lesions) {
    const Eigen::Vector3d& at = lesion.centroid_in_lps;
    toml << "[[lesions]]\nid = \"" << lesion.id << "\"\npoint_lps_mm = [" << at.x() << ", "
         << at.y() << ", " << at.z() << "]\n";
  }
  write_text_atomically(imaged.file("patient.toml"), toml.str() + views_toml(stages));
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
double lesion_off(const std::string& view, const fs::path& pressed, const CoilStages& imaged,
                  const CoilStages& stages) {
  const auto segmentation = [](const CoilStages& of) { return of.file("segmentation.seg.nrrd"); };
  const PressedPlaces found(pressed, view, segmentation(imaged));
  const PressedPlaces truly(stages.file(view + ".vtu"), view, segmentation(stages));
  const auto lesions = [&](const CoilStages& of) {
    return read_segmentation(segmentation(of), of.file("fractions.nrrd")).lesions;
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
  for (const char* key :
       {"volume_ml", "taken_off_kpa", "plates_N", "plates_kpa", "left_cm2", "right_cm2", "apart_mm",
        "shape_rms_mm", "lesion_cc_mm", "lesion_mlo_mm", "stiffened", "reason"})
    row[key] = nullptr;
  return row;
}

/// What comes of taking off one pressure; the files carry its number in their names.
void take_off(double pressure_kpa, const CoilTruth& truth, const CoilStages& imaged,
              const CoilStages& stages, json& row) {
  row["taken_off_kpa"] = pressure_kpa;
  const std::string number = json(pressure_kpa).dump(), unloaded = "unloaded_" + number + ".vtu";
  imaged.run("unload", unloaded, {"--coil-pressure-kpa", number});
  const json quality = stage_sidecar(imaged.file(unloaded)).at("quality");
  row["stiffened"] = quality.at("stiffened");
  if (const json& plates = quality.at("coil_plates"); !plates.is_null())
    for (const char* key : {"left_cm2", "right_cm2", "apart_mm"}) row[key] = plates.at(key);
  row["shape_rms_mm"] = shape_rms(imaged.file(unloaded), truth);
  for (const std::string view : kViews) {
    const std::string pressed = view + "_" + number + ".vtu";
    imaged.press(view, unloaded, pressed);
    row["lesion_" + view + "_mm"] = lesion_off(view, imaged.file(pressed), imaged, stages);
  }
}

}  // namespace

void add_coil_rows(const CoilCase& asked, const std::function<void(const json&)>& add) {
  json row = new_coil_row(asked);
  try {
    const CoilStages stages(asked.folder / "truth"), imaged(asked.folder / "imaged");
    const CoilTruth truth = make_truth(asked, stages);
    write_imaged(truth, imaged, stages);
    row["volume_ml"] = truth.imaged.truth.breast_ml;
    row["plates_N"] = truth.force_N;
    if (truth.force_N > 0) row["plates_kpa"] = kKpaPerNPerCm2 * truth.force_N / truth.area_cm2;
    imaged.run("segment", "segmentation.seg.nrrd");
    imaged.run("fit", "prone.vtu");
    for (const double pressure_kpa : asked.pressures) {
      json one = row;
      try {
        take_off(pressure_kpa, truth, imaged, stages, one);
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
