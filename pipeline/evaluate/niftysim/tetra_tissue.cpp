#include "pipeline/evaluate/niftysim/tetra_tissue.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>

namespace mammotwin {
namespace {

constexpr double kGridMm = 1;

Eigen::Matrix3d edges(const NiftySimModel& model, int t) {
  const auto& c = model.tetrahedra[t];
  Eigen::Matrix3d e;
  for (int i = 0; i < 3; ++i) e.col(i) = model.nodes[c[i + 1]] - model.nodes[c[0]];
  return e;
}

/// Calls visit(voxel) for every grid point in a tetrahedron.
template <class Visit>
void for_voxels(const NiftySimModel& model, int t, const Volume<Fractions>& grid,
                const Visit& visit) {
  constexpr double rounding = -1e-9;
  Eigen::Vector3d low = model.nodes[model.tetrahedra[t][0]], high = low;
  for (const int n : model.tetrahedra[t])
    low = low.cwiseMin(model.nodes[n]), high = high.cwiseMax(model.nodes[n]);
  const Eigen::Matrix3d inverse = edges(model, t).inverse();
  const Eigen::Vector3i from = grid.index(low).array().ceil().cast<int>();
  const Eigen::Vector3i to = grid.index(high).array().floor().cast<int>();
  for (int k = from.z(); k <= to.z(); ++k)
    for (int j = from.y(); j <= to.y(); ++j)
      for (int i = from.x(); i <= to.x(); ++i) {
        const Eigen::Vector3d b =
            inverse * (grid.position(i, j, k) - model.nodes[model.tetrahedra[t][0]]);
        if (b.minCoeff() >= rounding && b.sum() <= 1 - rounding) visit(grid.offset(i, j, k));
      }
}

Volume<Fractions> empty_grid(const NiftySimModel& model) {
  Eigen::Vector3d low = model.nodes[0], high = low;
  for (const auto& x : model.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(2 * kGridMm);
  const Eigen::Vector3i size = ((high - low + 2 * margin) / kGridMm).cast<int>();
  return Volume<Fractions>(size + Eigen::Vector3i::Ones(), Eigen::Vector3d::Constant(kGridMm),
                           low - margin);
}

}  // namespace

Volume<Fractions> tissue_of_tetrahedra(const NiftySimModel& model) {
  Volume<Fractions> tissue = empty_grid(model);
  for (std::size_t s = 0; s < model.sets.size(); ++s)
    for (const int t : model.sets[s].elements)
      for_voxels(model, t, tissue, [&](std::size_t voxel) {
        tissue.values[voxel] = s == 1 ? Fractions{0, 1, 0} : Fractions{1, 0, 0};
      });
  return tissue;
}

double volume_of_set(const NiftySimModel& model, int set) {
  double sum = 0;
  for (const int t : model.sets[set].elements) sum += std::abs(edges(model, t).determinant()) / 6;
  return sum;
}

std::vector<std::array<int, 3>> outer_faces(const NiftySimModel& model) {
  std::map<std::array<int, 3>, int> seen;
  for (const auto& c : model.tetrahedra)
    for (int left_out = 0; left_out < 4; ++left_out) {
      std::array<int, 3> face;
      for (int i = 0, n = 0; i < 4; ++i)
        if (i != left_out) face[n++] = c[i];
      std::sort(face.begin(), face.end());
      ++seen[face];
    }
  std::vector<std::array<int, 3>> outer;
  for (const auto& [face, count] : seen)
    if (count == 1) outer.push_back(face);
  return outer;
}

}  // namespace mammotwin
