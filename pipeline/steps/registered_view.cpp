#include "pipeline/steps/registered_view.h"

#include <stdexcept>
#include <utility>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/steps/registered_record.h"
#include "pipeline/steps/solution_record.h"
#include "registration/export/landmark_table.h"

namespace mammotwin {
RegisteredView read_registered_view(const std::string& name, const std::filesystem::path& path,
                                    const ViewSettings& settings) {
  const MeshFile file = read_mesh_file(path);
  const auto prone = file.configurations.find("prone");
  if (prone == file.configurations.end())
    throw std::runtime_error(path.string() +
                             ": has no configuration \"prone\"; was it made by compress?");
  const std::string file_name = path.filename().string();
  const CompressedView view = compressed_view(name, file_name, file.metadata);
  const RegisteredRecord record = read_registered(file, file_name);
  HermiteMesh mesh(prone->second, file.mesh.elements());
  ViewProjection projection(
      mesh, file.mesh, view, settings.detector(name, view.side),
      record.baseline ? std::optional(baseline_of(*record.baseline, mesh, view)) : std::nullopt);
  std::map<std::string, HermiteMesh> states;
  for (const auto& [state, nodes] : file.configurations)
    if (state != "prone" && state != kRounderByCoil && !is_of_registration(state))
      states.emplace(state, HermiteMesh(nodes, file.mesh.elements()));
  return {file,
          std::move(mesh),
          file.mesh,
          std::move(projection),
          std::move(states),
          record.uncertainty,
          record.what_if,
          record.end};
}

void write_registered_view(const std::filesystem::path& path, const RegisteredView& view) {
  MeshFile file = view.file;
  file.mesh = view.compressed;
  file.fields.clear();  // stresses are those of the state before the search
  write_view(view.projection.view(), file.metadata);
  write_registered(
      {record_of(view.projection.baseline()), view.uncertainty, view.what_if, view.end}, file);
  erase_solution(file);
  write_mesh_file(path, file);
}

std::optional<Eigen::Matrix2d> RegisteredView::covariance(const MeshPoint& point) const {
  if (!uncertainty) return std::nullopt;
  return detector_covariance(*uncertainty, compressed, projection.view(), projection.detector(),
                             point);
}

std::optional<Eigen::Matrix2d> RegisteredView::covariance_in_picture(const MeshPoint& point) const {
  if (!uncertainty) return std::nullopt;
  return detector_covariance(without_placement(*uncertainty), compressed, projection.view(),
                             projection.detector(), point);
}

std::string landmark_errors(const std::filesystem::path& file,
                            const std::vector<RegisteredView>& views) {
  const std::vector<LandmarkPair> pairs = read_landmark_pairs(file);
  std::map<std::string, ViewRays> rays;
  std::map<std::string, JudgedView> judged;
  for (const RegisteredView& view : views) {
    const std::string& name = view.projection.view().name;
    const auto [at, is_new] = rays.try_emplace(name, view.prone, view.compressed,
                                               view.projection.view(), view.projection.detector());
    judged[name] = {&view.projection, &at->second};
  }
  for (const LandmarkPair& pair : pairs)
    for (const RegisteredView& view : views)
      if (const std::string& name = view.projection.view().name;
          pair.marks.contains(name) && !view.projection.detector().pixels)
        throw std::runtime_error(file.string() + ": " + pair.name + " has a mark on " + name +
                                 ", but patient.toml has no views." + name +
                                 ".detector.pixel_spacing_mm, columns and rows");
  return target_error_table(target_errors(pairs, judged));
}

}  // namespace mammotwin
