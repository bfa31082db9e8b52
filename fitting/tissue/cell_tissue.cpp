#include "fitting/tissue/cell_tissue.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "fitting/tissue/gauss_points.h"

namespace mammotwin {

namespace {

// Sums of the gauss_weights, where cells end.
constexpr std::array<double, 3> ends = {0.17392742256872693, 0.5, 0.82607257743127307};

constexpr int cells_per_element = 64;
// The wall is a spline within 2 mm of the muscle; a tumour's pit in it is deeper than it follows.
constexpr double reach_mm = 5;

int interval(double xi) {
  return static_cast<int>(std::upper_bound(ends.begin(), ends.end(), xi) - ends.begin());
}

int cell_of(const MeshPoint& p) {
  return cells_per_element * p.element + interval(p.xi.x()) +
         4 * (interval(p.xi.y()) + 4 * interval(p.xi.z()));
}

/// Volume [mm³] that the Gauss point of a cell stands for.
double weight_of(const HermiteMesh& mesh, int cell) {
  const int i = cell % 4, j = cell / 4 % 4, k = cell / 16 % 4;
  const MeshPoint p{cell / cells_per_element, {gauss_points[i], gauss_points[j], gauss_points[k]}};
  return gauss_weights[i] * gauss_weights[j] * gauss_weights[k] * mesh.jacobian(p).determinant();
}

/// Voxel indices [first, last] of a box.
struct IndexBox {
  Eigen::Vector3i first, last;
};

/// The mesh's box, `reach_mm` larger along y.
IndexBox box_of(const HermiteMesh& mesh, const Volume<Fractions>& v) {
  Eigen::AlignedBox3d box;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const BezierElement control = bezier_element(mesh, e);
    for (int c = 0; c < control.cols(); ++c) box.extend(control.col(c).eval());
  }
  // Control gauss_points may stand beyond the cut planes, which corners of elements reach.
  Eigen::AlignedBox3d corners;
  for (const auto& node : mesh.nodes()) corners.extend(node.col(0).eval());
  const Eigen::Vector3d low(corners.min().x(), box.min().y() - reach_mm, corners.min().z());
  const Eigen::Vector3d high(corners.max().x(), box.max().y() + reach_mm, corners.max().z());
  const auto ceiling = [](double t) { return static_cast<int>(std::ceil(t)); };
  const auto floor = [](double t) { return static_cast<int>(std::floor(t)); };
  return {v.index(low).unaryExpr(ceiling).cast<int>().cwiseMax(0),
          v.index(high).unaryExpr(floor).cast<int>().cwiseMin(v.size - Eigen::Vector3i::Ones())};
}

struct CountedVoxel {
  int cell;
  Fractions fractions;
};

/// Voxels of one slice of the volume, each with its cell.
std::vector<CountedVoxel> count_slice(const HermiteMesh& mesh, const InverseMap& map,
                                      const Volume<Fractions>& v, const IndexBox& box, int k) {
  std::vector<CountedVoxel> counted;
  MeshPoint guess{0, Eigen::Vector3d::Constant(0.5)};
  for (int i = box.first.x(); i <= box.last.x(); ++i)
    for (int j = box.first.y(); j <= box.last.y(); ++j) {
      const Fractions& f = v(i, j, k);
      if (f.fat + f.fibroglandular + f.lesion <= 0) continue;
      const Eigen::Vector3d x = v.position(i, j, k);
      if (const auto found = map.locate(x, guess)) {
        guess = *found;
      } else {
        const MeshPoint nearest = map.nearest(x);
        if ((mesh.position(nearest) - x).norm() > reach_mm) continue;
        guess = nearest;
      }
      counted.push_back({cell_of(guess), f});
    }
  return counted;
}

std::vector<CountedVoxel> count(const InverseMap& map, const HermiteMesh& mesh,
                                const Volume<Fractions>& v) {
  const IndexBox box = box_of(mesh, v);
  std::vector<std::vector<CountedVoxel>> slices(v.size.z());
  tbb::parallel_for(box.first.z(), box.last.z() + 1,
                    [&](int k) { slices[k] = count_slice(mesh, map, v, box, k); });
  std::vector<CountedVoxel> all;
  for (const auto& slice : slices) all.insert(all.end(), slice.begin(), slice.end());
  return all;
}

/// One tissue in every cell.
struct Tally {
  explicit Tally(std::size_t cells) : share(cells, 0), weight(cells, 0), room(cells, 1) {}

  std::vector<double> share;   ///< of the cell's voxels
  std::vector<double> weight;  ///< of the cell's point [mm³]
  std::vector<double> room;    ///< the largest share that a cell may have
  double volume = 0;           ///< of the voxels [mm³]

  /// A cell has a few voxels more or fewer than its weight: shares that are less than all are
  /// scaled until the gauss_points hold the voxels' volume.
  void keep_volume() {
    constexpr int rounds = 5;  // each leaves what newly full cells could not take
    for (int round = 0; round < rounds; ++round) {
      double full = 0, part = 0;
      for (std::size_t c = 0; c < share.size(); ++c) {
        share[c] = std::min(share[c], room[c]);
        (share[c] < room[c] ? part : full) += share[c] * weight[c];
      }
      if (part <= 0) return;
      const double factor = std::max(0.0, volume - full) / part;
      for (std::size_t c = 0; c < share.size(); ++c)
        if (share[c] < room[c]) share[c] = std::min(room[c], factor * share[c]);
    }
  }
};

}  // namespace

CellTissue::CellTissue(const HermiteMesh& mesh, const Volume<Fractions>& fractions)
    : map_(mesh), cells_(cells_per_element * mesh.num_elements()) {
  Tally lesion(cells_.size()), gland(cells_.size());
  std::vector<double> all(cells_.size(), 0);
  for (const auto& [cell, f] : count(map_, mesh, fractions)) {
    lesion.share[cell] += f.lesion;
    gland.share[cell] += f.fibroglandular;
    all[cell] += f.fat + f.fibroglandular + f.lesion;
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    lesion.weight[c] = gland.weight[c] = weight_of(mesh, static_cast<int>(c));
    for (Tally* tally : {&lesion, &gland}) {
      tally->volume += tally->share[c] * fractions.voxel_volume();
      if (all[c] > 0) tally->share[c] /= all[c];
    }
  }
  lesion.keep_volume();
  for (std::size_t c = 0; c < cells_.size(); ++c) gland.room[c] = 1 - lesion.share[c];
  gland.keep_volume();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double fat = 1 - gland.share[c] - lesion.share[c];  // of a full cell: 0 but for rounding
    cells_[c] = {static_cast<float>(std::max(0.0, fat)), static_cast<float>(gland.share[c]),
                 static_cast<float>(lesion.share[c])};
  }
}

Fractions CellTissue::at(const Eigen::Vector3d& x) const {
  const auto found = map_.locate(x);
  return cells_[cell_of(found ? *found : map_.nearest(x))];
}

}  // namespace mammotwin
