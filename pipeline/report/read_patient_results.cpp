#include <algorithm>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "pipeline/frame/sidecar.h"
#include "pipeline/report/patient_results.h"
#include "registration/export/detector_record.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProductsInOrder[] = {
    "segmentation.seg.nrrd", "prone.vtu", "unloaded.vtu", "cc.vtu", "mlo.vtu", "lesions.csv"};
constexpr const char* kViews[] = {"cc", "mlo"};

void read_sidecars(const fs::path& folder, PatientResults& results) {
  for (const char* product : kProductsInOrder) {
    SidecarFile file = read_sidecar(folder / product);
    if (file.sidecar)
      results.stages.push_back({product, std::move(*file.sidecar)});
    else if (!file.fault.empty())
      results.notes.push_back(std::string(product) + ".json is not used: " + file.fault);
  }
}

/// Runs `read` if the file exists; what it throws becomes a note.
void try_read(const fs::path& file, PatientResults& results, const std::function<void()>& read) {
  if (!fs::exists(file)) return;
  try {
    read();
  } catch (const std::exception& error) {
    results.notes.push_back(file.filename().string() + " could not be read: " + error.what());
  }
}

/// The geometry that `register` used for a view; defaults where its sidecar says nothing.
Detector detector_of(const PatientResults& results, const std::string& view) {
  const nlohmann::json* sidecar = results.sidecar("lesions.csv");
  const nlohmann::json::json_pointer place("/quality/detectors/" + view);
  return sidecar && sidecar->contains(place) ? read_detector_record((*sidecar)[place]) : Detector();
}

void read_view(const fs::path& folder, const std::string& name, PatientResults& results) {
  fs::path path = folder / (name + "_registered.vtu");  // once register has run
  if (!fs::exists(folder / "lesions.csv") || !fs::exists(path)) path = folder / (name + ".vtu");
  try_read(path, results, [&] {
    MeshFile file = read_mesh_file(path);
    CompressedView view = compressed_view(name, path.filename().string(), file.metadata);
    if (!results.prone && file.configurations.contains("prone")) {
      results.prone = file;
      results.prone->mesh = HermiteMesh(file.configurations.at("prone"), file.mesh.elements());
    }
    results.views.push_back({std::move(file), std::move(view), detector_of(results, name)});
  });
}

}  // namespace

PatientResults read_patient_results(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw std::runtime_error(folder.string() + ": no such folder of results");
  PatientResults results;
  results.patient = fs::weakly_canonical(folder).filename().string();
  read_sidecars(folder, results);
  try_read(folder / "mri.nrrd", results,
           [&] { results.mri = read_image_file(folder / "mri.nrrd"); });
  try_read(folder / "segmentation.seg.nrrd", results, [&] {
    results.segmentation =
        read_segmentation(folder / "segmentation.seg.nrrd", folder / "fractions.nrrd");
  });
  try_read(folder / "prone.vtu", results,
           [&] { results.prone = read_mesh_file(folder / "prone.vtu"); });
  try_read(folder / "unloaded.vtu", results,
           [&] { results.unloaded = read_mesh_file(folder / "unloaded.vtu").mesh; });
  try_read(folder / "lesions.csv", results,
           [&] { results.rows = read_lesion_table(folder / "lesions.csv"); });
  for (const char* view : kViews) read_view(folder, view, results);
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) results.files.push_back(entry.path().filename().string());
  std::sort(results.files.begin(), results.files.end());
  return results;
}

}  // namespace mammotwin
