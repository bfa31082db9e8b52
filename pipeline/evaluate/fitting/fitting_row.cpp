#include "pipeline/evaluate/fitting/fitting_row.h"

#include <map>
#include <nlohmann/json.hpp>

#include "fitting/mesh/mesh_file.h"
#include "fitting/tissue/cell_tissue.h"
#include "fitting/tissue/tissue_volumes.h"
#include "pipeline/evaluate/cases/breast_inputs.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/frame/products.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json relative_error(double found, double expected) {
  if (expected < 1) return nullptr;  // [ml]: too little to be a fraction of
  return found / expected - 1;
}

/// The sidecar of a command that wrote `product`; throws std::runtime_error with its first reason
/// where it left none.
json sidecar_of(const fs::path& product, const StageEnd& end) {
  const json sidecar = stage_sidecar(product);
  if (end.exit_code == 0) return sidecar;
  const json reasons = sidecar.is_object() ? sidecar.value("reasons", json::array()) : json();
  throw std::runtime_error(product.filename().string() + ": " +
                           (reasons.empty()
                                ? "the command ended with code " + std::to_string(end.exit_code)
                                : reasons.front().get<std::string>()));
}

/// Volume [ml] of every lesion label: of the voxels, and at the Gauss points, each of which counts
/// for the lesion of the nearest voxel.
class LesionVolumes {
 public:
  explicit LesionVolumes(const Segmentation& s) {
    for (int k = 0; k < s.labels.size.z(); ++k)
      for (int j = 0; j < s.labels.size.y(); ++j)
        for (int i = 0; i < s.labels.size.x(); ++i)
          if (const int value = s.labels(i, j, k); s.fractions(i, j, k).lesion > 0) {
            if (!label::is_lesion(value)) continue;
            voxels_.push_back({s.labels.position(i, j, k), value});
            in_voxels_[value] += s.fractions(i, j, k).lesion * s.labels.voxel_volume() / 1000;
          }
  }

  void add(const Eigen::Vector3d& x, double volume_ml) {
    if (volume_ml <= 0 || voxels_.empty()) return;
    const auto nearer = [&](const Voxel& a, const Voxel& b) {
      return (a.x - x).squaredNorm() < (b.x - x).squaredNorm();
    };
    at_points_[std::min_element(voxels_.begin(), voxels_.end(), nearer)->label] += volume_ml;
  }

  json errors() const {
    json list = json::array();
    for (const auto& [label, ml] : in_voxels_) {
      const auto found = at_points_.find(label);
      const double points_ml = found == at_points_.end() ? 0 : found->second;
      list.push_back({{"id", label - label::lesion + 1},
                      {"volume_ml", ml},
                      {"volume_error", relative_error(points_ml, ml)}});
    }
    return list;
  }

 private:
  struct Voxel {
    Eigen::Vector3d x;
    int label;
  };
  std::vector<Voxel> voxels_;
  std::map<int, double> in_voxels_, at_points_;
};

json tissue_errors(const fs::path& folder) {
  const Segmentation s =
      read_segmentation(folder / "segmentation.seg.nrrd", folder / "fractions.nrrd");
  const HermiteMesh mesh = read_mesh_file(folder / "prone.vtu").mesh;
  const CellTissue tissue(mesh, s.fractions);
  const TissueVolumes voxels = tissue_in_voxels(s);
  LesionVolumes lesions(s);
  const TissueVolumes points = tissue_in_mesh(mesh, [&](const Eigen::Vector3d& x, double volume) {
    const Fractions f = tissue.at(x);
    lesions.add(x, f.lesion * volume / 1000);
    return f;
  });
  return {
      {"volume_error", relative_error(points.total(), voxels.total())},
      {"fat_volume_error", relative_error(points.fat, voxels.fat)},
      {"fibroglandular_volume_error", relative_error(points.fibroglandular, voxels.fibroglandular)},
      {"lesions", lesions.errors()}};
}

json fit(const BreastToFit& breast, const fs::path& folder, const FitRun& run) {
  fs::create_directories(folder);
  breast.segment(folder);
  const auto file = [&](const char* name) { return (folder / name).string(); };
  std::vector<std::string> arguments = {file("segmentation.seg.nrrd"), file("fractions.nrrd"),
                                        file("prone.vtu")};
  arguments.insert(arguments.end(), run.options.begin(), run.options.end());
  if (run.again) arguments.push_back("--force");
  const StageEnd end =
      run.other_program.empty()
          ? run_stage_command("fit", arguments, folder / "fit.log", kMostStageCpuSeconds)
          : run_program(run.other_program, arguments, folder / "fit.log", kMostStageCpuSeconds);
  const json sidecar = sidecar_of(folder / "prone.vtu", end);
  json row = sidecar.at("quality");
  for (const char* key : {"status", "reasons", "seconds", "peak_memory_mb"})
    row[key] = sidecar.at(key);
  row["cpu_seconds"] = run.again ? json(end.cpu_seconds) : json();
  row.update(tissue_errors(folder));
  return row;
}

}  // namespace

BreastToFit to_fit(const RealBreast& breast) {
  return {
      breast.name, "patient", breast.side, [breast](const fs::path& folder) {
        write_text_atomically(folder / "patient.toml", patient_toml_of(breast));
        run_to_product({"segment", {}, folder / "segmentation.seg.nrrd", folder / "patient.toml"});
      }};
}

BreastToFit to_fit(const SyntheticBreast& breast) {
  return {breast.name, "drawn", breast.patient.anatomy.side,
          [breast](const fs::path& folder) { segment_drawn(breast, folder); }};
}

json fitting_row(const BreastToFit& breast, const fs::path& folder, const FitRun& run) {
  json row = {{"name", breast.name},
              {"kind", breast.kind},
              {"side", breast.side == Side::left ? "left" : "right"},
              {"reason", nullptr}};
  try {
    row.update(fit(breast, folder, run));
  } catch (const std::exception& error) {
    row["status"] = "refused";
    row["reason"] = error.what();
  }
  return row;
}

}  // namespace mammotwin
