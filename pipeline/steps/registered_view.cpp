#include "pipeline/steps/registered_view.h"

#include <stdexcept>
#include <utility>

#include "fitting/mesh/mesh_file.h"
#include "registration/export/landmark_table.h"
#include "registration/export/view_products.h"
#include "segmentation/files/segmentation_file.h"

namespace mammotwin {
namespace {

const std::string kVaried = "varied_";

/// Of a file that register wrote: frame of the header's view, thickness, turn and shifts.
std::vector<double> numbers_of(const AffineBaseline& baseline) {
  const ViewFrame& frame = baseline.frame();
  std::vector<double> numbers(frame.origin_in_lps.begin(), frame.origin_in_lps.end());
  const Eigen::Matrix3d columns = frame.axes.transpose();
  numbers.insert(numbers.end(), columns.data(), columns.data() + columns.size());
  numbers.insert(numbers.end(), {baseline.thickness_mm(), baseline.turn_deg(),
                                 baseline.shift_mm().x(), baseline.shift_mm().y()});
  return numbers;
}

std::optional<AffineBaseline> read_baseline(const MeshFile& file, const HermiteMesh& prone,
                                            CompressedView view) {
  const auto found = file.metadata.find("baseline");
  if (found == file.metadata.end()) return std::nullopt;
  const std::vector<double>& n = found->second;
  if (n.size() != 16) throw std::runtime_error("the field baseline has not 16 numbers");
  view.frame.origin_in_lps = Eigen::Vector3d(n.data());
  view.frame.axes = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(n.data() + 3);
  view.thickness_mm = n[12];
  AffineBaseline baseline(prone, view);
  baseline.place(n[13], {n[14], n[15]});
  return baseline;
}

std::optional<ViewUncertainty> read_uncertainty(const MeshFile& file) {
  const auto covariance = file.metadata.find("state_covariance");
  const auto sd = file.metadata.find("state_sd");
  if (covariance == file.metadata.end() || sd == file.metadata.end()) return std::nullopt;
  ViewUncertainty uncertainty;
  if (sd->second.size() != kStates || covariance->second.size() != kStates * kStates)
    throw std::runtime_error("the fields state_sd and state_covariance have another length than " +
                             std::to_string(kStates) + " and its square");
  uncertainty.sd = ViewState(sd->second.data());
  uncertainty.covariance = Eigen::Matrix<double, kStates, kStates>(covariance->second.data());
  for (int i = 0; i < kMechanical; ++i)
    if (const auto varied = file.configurations.find(kVaried + kStateNames[i]);
        varied != file.configurations.end())
      uncertainty.varied[i] = varied->second;
  return uncertainty;
}

void write_uncertainty(const ViewUncertainty& uncertainty, MeshFile& file) {
  file.metadata["state_sd"] = {uncertainty.sd.begin(), uncertainty.sd.end()};
  const auto& c = uncertainty.covariance;
  file.metadata["state_covariance"] = {c.data(), c.data() + c.size()};
  for (int i = 0; i < kMechanical; ++i)
    if (!uncertainty.varied[i].empty())
      file.configurations[kVaried + kStateNames[i]] = uncertainty.varied[i];
}

}  // namespace

RegisteredView read_registered_view(const std::string& name, const std::filesystem::path& path,
                                    const ViewSettings& settings) {
  const MeshFile file = read_mesh_file(path);
  const auto prone = file.configurations.find("prone");
  if (prone == file.configurations.end())
    throw std::runtime_error(path.string() +
                             ": has no configuration \"prone\"; was it made by compress?");
  const CompressedView view = compressed_view(name, path.filename().string(), file.metadata);
  HermiteMesh mesh(prone->second, file.mesh.elements());
  ViewProjection projection(mesh, file.mesh, view, settings.detector(name, view.side),
                            read_baseline(file, mesh, view));
  std::map<std::string, HermiteMesh> states;
  for (const auto& [state, nodes] : file.configurations)
    if (state != "prone" && !state.starts_with(kVaried))
      states.emplace(state, HermiteMesh(nodes, file.mesh.elements()));
  return {file,
          std::move(mesh),
          file.mesh,
          std::move(projection),
          std::move(states),
          read_uncertainty(file)};
}

void write_registered_view(const std::filesystem::path& path, const RegisteredView& view) {
  MeshFile file = view.file;
  file.mesh = view.compressed;
  file.fields.clear();  // stresses are those of the state before the search
  write_view(view.projection.view(), file.metadata);
  if (view.uncertainty) write_uncertainty(*view.uncertainty, file);
  const AffineBaseline& baseline = view.projection.baseline();
  file.metadata["baseline"] = numbers_of(baseline);
  for (const char* solution : {"pressure_kpa", "plates"}) file.metadata.erase(solution);
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

nlohmann::json detector_json(const Detector& detector) {
  return {{"source_distance_mm", detector.source_distance_mm},
          {"support_gap_mm", detector.support_gap_mm}};
}

DetectorImage write_view_files(const RegisteredView& view, const Segmentation& segmentation,
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
  const SimulatedView simulated = simulate_view(
      view.prone, view.compressed, &segmentation.fractions, geometry, view.projection.detector());
  const DetectorImage shown = as_shown(simulated);
  write_view_png(products.write("simulated_" + name + ".png"), shown, geometry.side);
  if (mri)
    write_image(products.write("mri_in_" + name + ".nrrd"),
                mri_in_view(view.prone, view.compressed, *mri));
  return shown;
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
