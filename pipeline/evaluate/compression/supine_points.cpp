#include "pipeline/evaluate/compression/supine_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <stdexcept>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/evaluate/cases/sorted_figures.h"
#include "registration/carry/point_carrier.h"
#include "solver/breast/breast_model.h"

namespace mammotwin {
namespace {

constexpr double kMuscle_mm = 6;  // label maps: 4 to 8 mm in front of the ribs
constexpr double kNearestToRibs_mm = 10, kFarthestFromRibs_mm = 60;
constexpr double kAboveNipple_mm = 22, kMedialOfNipple_mm = 9;
constexpr int kLandmarks = 500, kMostDraws = 200'000, kLandmarkSeed = 1;

Eigen::AlignedBox3d box_of(const HermiteMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const HermiteMesh::Node& node : mesh.nodes()) box.extend(node.col(0));
  return box;
}

double sorted_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return median_of_sorted(values);
}

}  // namespace

SupinePoints::SupinePoints(const MeshFile& prone, Side side, const Eigen::Vector3d& nipple_in_lps)
    : side_(side),
      prone_(prone.mesh),
      wall_(prone.mesh, faces_labelled(prone, FaceLabel::chest_wall)),
      nipple_in_lps_(nipple_in_lps) {
  const InverseMap inverse(prone_);
  nipple_ = inverse.nearest(nipple_in_lps);
  const Eigen::AlignedBox3d box = box_of(prone_);
  std::mt19937 random(kLandmarkSeed);
  const auto share = [&] { return random() / 4294967296.0; };
  for (int n = 0; n < kMostDraws && landmarks_.size() < kLandmarks; ++n) {
    const Eigen::Vector3d shares(share(), share(), share());
    const Eigen::Vector3d x = box.min() + shares.cwiseProduct(box.sizes());
    const double outward = (side == Side::left ? 1 : -1) * (x - nipple_in_lps).x();
    if ((x - nipple_in_lps).z() < kAboveNipple_mm || outward < -kMedialOfNipple_mm) continue;
    const double ribs = wall_.gap(x).gap + kMuscle_mm;
    if (ribs < kNearestToRibs_mm || ribs > kFarthestFromRibs_mm) continue;
    if (const auto point = inverse.locate(x)) landmarks_.push_back({*point, x, ribs});
  }
  if (landmarks_.empty())
    throw std::runtime_error(
        "no tissue lies 22 mm above the nipple, beside it or lateral of it, 10 to 60 mm from the "
        "ribs");
}

SupineMoves SupinePoints::moves(const std::vector<HermiteMesh::Node>& supine_nodes) const {
  const HermiteMesh supine(supine_nodes, prone_.elements());
  SupineMoves moves;
  moves.nipple = carried_beside(prone_, supine, nipple_, nipple_in_lps_) - nipple_in_lps_;
  if (side_ == Side::right) moves.nipple.x() = -moves.nipple.x();
  std::vector<double> ways, prone, lying;
  for (const Landmark& landmark : landmarks_) {
    const Eigen::Vector3d x = supine.position(landmark.point);
    ways.push_back((x - landmark.prone).norm());
    prone.push_back(landmark.ribs_prone);
    lying.push_back(wall_.gap(x).gap + kMuscle_mm);
  }
  moves.landmark_mm = sorted_median(ways);
  moves.ribs_prone_mm = sorted_median(prone);
  moves.ribs_supine_mm = sorted_median(lying);
  return moves;
}

}  // namespace mammotwin
