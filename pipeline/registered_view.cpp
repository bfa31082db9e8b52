#include "pipeline/registered_view.h"

#include "fitting/mesh/mesh_file.h"
#include "registration/landmark_table.h"
#include "registration/view_products.h"
#include "segmentation/segmentation_file.h"

#include <stdexcept>
#include <utility>

namespace mammotwin {

RegisteredView read_registered_view(const std::string& name, const std::filesystem::path& path,
                                    const ViewSettings& settings) {
  const MeshFile file = read_mesh_file(path);
  const auto prone = file.configurations.find("prone");
  if (prone == file.configurations.end())
    throw std::runtime_error(path.string() +
                             ": has no configuration \"prone\"; was it made by compress?");
  const CompressedView view = compressed_view(name, path.filename().string(), file.metadata);
  HermiteMesh mesh(prone->second, file.mesh.elements());
  ViewProjection projection(mesh, file.mesh, view, settings.detector(name, view.side));
  std::map<std::string, HermiteMesh> states;
  for (const auto& [state, nodes] : file.configurations)
    if (state != "prone") states.emplace(state, HermiteMesh(nodes, file.mesh.elements()));
  return {std::move(mesh), file.mesh, std::move(projection), std::move(states)};
}

nlohmann::json detector_json(const Detector& detector) {
  return {{"source_distance_mm", detector.source_distance_mm},
          {"support_gap_mm", detector.support_gap_mm}};
}

void write_view_files(const RegisteredView& view, const Segmentation& segmentation,
                      const std::optional<Volume<float>>& mri, Products& products,
                      nlohmann::json& quality) {
  const CompressedView& geometry = view.projection.view();
  const std::string& name = geometry.name;
  const ViewFields fields = view_fields(view.prone, view.compressed);
  write_displacement_field(products.write(name + "_from_prone.nrrd"), fields.compressed_from_prone);
  write_displacement_field(products.write("prone_from_" + name + ".nrrd"),
                           fields.prone_from_compressed);
  quality["field_composition"][name] = {{"mean_mm", fields.error.mean_mm},
                                        {"p99_mm", fields.error.p99_mm},
                                        {"max_mm", fields.error.max_mm}};
  const SimulatedView simulated = simulate_view(view.prone, view.compressed, &segmentation.fractions,
                                                geometry, view.projection.detector());
  write_view_png(products.write("simulated_" + name + ".png"), as_shown(simulated), geometry.side);
  if (mri)
    write_image(products.write("mri_in_" + name + ".nrrd"),
                mri_in_view(view.prone, view.compressed, *mri));
}

std::string landmark_errors(const std::filesystem::path& file, const RegisteredView& cc,
                            const RegisteredView& mlo) {
  const std::vector<LandmarkPair> pairs = read_landmark_pairs(file);
  const auto rays = [](const RegisteredView& v) {
    return ViewRays(v.prone, v.compressed, v.projection.view(), v.projection.detector());
  };
  const ViewRays cc_rays = rays(cc), mlo_rays = rays(mlo);
  for (const LandmarkPair& pair : pairs)
    for (const RegisteredView* view : {&cc, &mlo})
      if (const std::string& name = view->projection.view().name;
          pair.marks.contains(name) && !view->projection.detector().pixels)
        throw std::runtime_error(file.string() + ": " + pair.name + " has a mark on " + name +
                                 ", but patient.toml has no views." + name +
                                 ".detector.pixel_spacing_mm, columns and rows");
  return target_error_table(target_errors(
      pairs, {{"cc", {&cc.projection, &cc_rays}}, {"mlo", {&mlo.projection, &mlo_rays}}}));
}

}  // namespace mammotwin
