#include "pipeline/evaluate/compression/gravity_row.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "pipeline/evaluate/cases/sorted_figures.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/pressed_places.h"
#include "pipeline/frame/products.h"
#include "pipeline/synthesize/options.h"
#include "registration/carry/point_carrier.h"
#include "segmentation/segmentation_file.h"
#include "solver/load/wall_surface.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMuscle_mm = 6;  // label maps: 4 to 8 mm in front of the ribs
constexpr double kNearestToRibs_mm = 10, kFarthestFromRibs_mm = 60;
constexpr int kLandmarks = 500, kMostDraws = 200'000, kLandmarkSeed = 1;

HermiteMesh configuration(const MeshFile& file, const std::string& name) {
  const auto found = file.configurations.find(name);
  if (found == file.configurations.end())
    throw std::runtime_error("no equilibrium was found " + name);
  return HermiteMesh(found->second, file.mesh.elements());
}

WallSurface wall_of(const HermiteMesh& prone, const std::vector<FaceLabels>& faces) {
  std::vector<std::pair<int, int>> wall;
  for (int element = 0; element < static_cast<int>(faces.size()); ++element)
    for (int face = 0; face < 6; ++face)
      if (faces[element][face] == FaceLabel::chest_wall) wall.emplace_back(element, face);
  return WallSurface(prone, wall);
}

Eigen::AlignedBox3d box_of(const HermiteMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const HermiteMesh::Node& node : mesh.nodes()) box.extend(node.col(0));
  return box;
}

/// A point of the tissue in both poses, and how far it is from the ribs there [mm].
struct TissuePoint {
  double way = 0, ribs_prone = 0, ribs_supine = 0;
};

std::vector<TissuePoint> tissue_points(const PointCarrier& to_supine, const WallSurface& wall,
                                       const Eigen::AlignedBox3d& box) {
  std::vector<TissuePoint> all;
  std::mt19937 random(kLandmarkSeed);
  const auto share = [&] { return random() / 4294967296.0; };
  for (int n = 0; n < kMostDraws && all.size() < kLandmarks; ++n) {
    const Eigen::Vector3d shares(share(), share(), share());
    const Eigen::Vector3d prone = box.min() + shares.cwiseProduct(box.sizes());
    const double ribs = wall.gap(prone).gap + kMuscle_mm;
    if (ribs < kNearestToRibs_mm || ribs > kFarthestFromRibs_mm) continue;
    if (const auto supine = to_supine.carry_inside(prone))
      all.push_back({(*supine - prone).norm(), ribs, wall.gap(*supine).gap + kMuscle_mm});
  }
  if (all.empty()) throw std::runtime_error("no tissue lies 10 to 60 mm from the ribs");
  return all;
}

double median_of(const std::vector<TissuePoint>& points, double TissuePoint::*figure) {
  std::vector<double> values;
  for (const TissuePoint& point : points) values.push_back(point.*figure);
  std::sort(values.begin(), values.end());
  return median_of_sorted(values);
}

/// LPS to lateral, posterior, superior.
Eigen::Vector3d anatomical(Eigen::Vector3d way, Side side) {
  if (side == Side::right) way.x() = -way.x();
  return way;
}

}  // namespace

SupineMoves supine_moves(const MeshFile& unloaded, Side side,
                         const Eigen::Vector3d& nipple_in_lps) {
  const HermiteMesh prone = configuration(unloaded, "prone"),
                    supine = configuration(unloaded, "supine");
  const PointCarrier to_supine(prone, supine);
  const auto points = tissue_points(to_supine, wall_of(prone, unloaded.faces), box_of(prone));
  return {anatomical(to_supine.carry(nipple_in_lps).in_lps - nipple_in_lps, side),
          median_of(points, &TissuePoint::way), median_of(points, &TissuePoint::ribs_prone),
          median_of(points, &TissuePoint::ribs_supine)};
}

json gravity_row(const RealBreast& breast, const fs::path& folder,
                 const std::vector<std::string>& unload_options) {
  json row{{"name", breast.name}, {"side", name_of(breast.side)}};
  for (const char* key :
       {"status", "reason", "nipple_l_mm", "nipple_p_mm", "nipple_s_mm", "nipple_mm", "landmark_mm",
        "ribs_prone_mm", "ribs_supine_mm", "cpu_seconds"})
    row[key] = nullptr;
  const fs::path toml = folder / "patient.toml", segmentation = folder / "segmentation.seg.nrrd",
                 prone = folder / "prone.vtu", unloaded = folder / "unloaded.vtu";
  const std::string fractions = fractions_beside(segmentation).string();
  try {
    fs::create_directories(folder);
    write_text_atomically(toml, patient_toml_of(breast));
    run_to_product({"segment", {}, segmentation, toml});
    run_to_product({"fit", {segmentation.string(), fractions}, prone, toml});
    fs::remove(unloaded);
    fs::remove(unloaded.string() + ".json");
    row["cpu_seconds"] = run_to_product({"unload",
                                         {segmentation.string(), fractions, prone.string()},
                                         unloaded,
                                         toml,
                                         unload_options});
    const SupineMoves moves =
        supine_moves(read_mesh_file(unloaded), breast.side,
                     read_segmentation(segmentation, fractions).nipple_in_lps);
    row["nipple_l_mm"] = moves.nipple.x();
    row["nipple_p_mm"] = moves.nipple.y();
    row["nipple_s_mm"] = moves.nipple.z();
    row["nipple_mm"] = moves.nipple.norm();
    row["landmark_mm"] = moves.landmark_mm;
    row["ribs_prone_mm"] = moves.ribs_prone_mm;
    row["ribs_supine_mm"] = moves.ribs_supine_mm;
  } catch (const std::exception& error) {
    row["reason"] = error.what();
  }
  if (const json sidecar = stage_sidecar(unloaded); sidecar.is_object())
    row["status"] = sidecar.at("status");
  return row;
}

}  // namespace mammotwin
