#include "pipeline/evaluate/compression/supine_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <stdexcept>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/evaluate/cases/sorted_figures.h"
#include "registration/carry/point_carrier.h"
#include "solver/breast/breast_model.h"

namespace mammotwin {
namespace {

constexpr double kMuscle_mm = 6;  // label maps: 4 to 8 mm in front of the ribs
/// Bounds of bands of distance from the ribs [mm], and how many of the women's 54 lie in each.
constexpr std::array kBands_mm{kNearestToRibs_mm,   15.0, 20.0, 30.0, 40.0, 50.0,
                               kFarthestFromRibs_mm};
constexpr std::array kWomensInBand{13, 16, 7, 7, 5, 6};
constexpr int kWomens = std::accumulate(kWomensInBand.begin(), kWomensInBand.end(), 0);
constexpr double kAboveNipple_mm = 22, kMedialOfNipple_mm = 9;
constexpr int kLandmarks = 540, kMostDraws = 200'000, kLandmarkSeed = 1;

Eigen::AlignedBox3d box_of(const HermiteMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const HermiteMesh::Node& node : mesh.nodes()) box.extend(node.col(0));
  return box;
}

std::size_t band_of(double ribs_mm) {
  return std::upper_bound(kBands_mm.begin() + 1, kBands_mm.end() - 1, ribs_mm) -
         (kBands_mm.begin() + 1);
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
  std::array<int, kWomensInBand.size()> left;
  for (std::size_t band = 0; band < left.size(); ++band)
    left[band] = kLandmarks * kWomensInBand[band] / kWomens;
  const auto any_left = [&] {
    return std::any_of(left.begin(), left.end(), [](int wanted) { return wanted > 0; });
  };
  for (int n = 0; n < kMostDraws && any_left(); ++n) {
    const Eigen::Vector3d shares(share(), share(), share());
    const Eigen::Vector3d x = box.min() + shares.cwiseProduct(box.sizes());
    const double outward = (side == Side::left ? 1 : -1) * (x - nipple_in_lps).x();
    if ((x - nipple_in_lps).z() < kAboveNipple_mm || outward < -kMedialOfNipple_mm) continue;
    const double ribs = wall_.gap(x).gap + kMuscle_mm;
    if (ribs < kNearestToRibs_mm || ribs > kFarthestFromRibs_mm) continue;
    int& wanted = left[band_of(ribs)];
    if (wanted == 0) continue;
    if (const auto point = inverse.locate(x)) {
      landmarks_.push_back({*point, x, ribs});
      --wanted;
    }
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
