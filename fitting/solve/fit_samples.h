#pragma once

#include "fitting/slab/skin_patches.h"
#include "fitting/solve/plane_samples.h"
#include "fitting/surface/closest_point.h"

namespace mammotwin {

/// Skin and wall that a slab is fitted to, and where on the slab each datum was last seen.
class FitTarget {
 public:
  FitTarget(const Slab& slab, const TriangleSurface& skin, const FlatSkin& flat,
            const HeightField& wall, const Eigen::Vector3d& nipple);

  /// How strongly each kind of mean squared distance counts.
  struct Weights {
    double all = 1;  ///< times all of those below
    double data_to_mesh = 1, mesh_to_data = 0.5, edges = 0.5, wall = 0.25;
  };

  /// Gives each of the mesh's skin samples the share of this mesh's skin that it stands for. Shares
  /// that followed the mesh would let a fit shrink what is far from the data.
  void weigh_mesh(const HermiteMesh& mesh);

  /// Finds the nearest points anew and makes one plane sample of each; `weigh_mesh` comes first.
  std::vector<PlaneSample> samples(const HermiteMesh& mesh, const Weights& weights);

  /// Back to where the flattening puts every datum.
  void forget_feet();

  /// Root mean square of data to mesh [mm] when samples were last made.
  double skin_rms() const { return skin_rms_; }

 private:
  int num_mesh_samples() const;
  SkinPatches::Coordinates mesh_sample(int index) const;
  double importance(const Eigen::Vector3d& x) const;  ///< 1, more round the nipple
  void add_data_to_mesh(const SkinPatches& patches, double weight, std::vector<PlaneSample>& out);
  void add_edges(const SkinPatches& patches, double weight, std::vector<PlaneSample>& out);
  void add_mesh_to_data(const SkinPatches& patches, double weight, std::vector<PlaneSample>& out);
  void add_wall(const HermiteMesh& mesh, double weight, std::vector<PlaneSample>& out) const;

  Slab slab_;
  const TriangleSurface& skin_;
  const FlatSkin& flat_;
  const HeightField& wall_;
  Eigen::Vector3d nipple_;
  ClosestPoint closest_;
  std::vector<double> areas_;                   ///< share of each vertex, sum 1
  std::vector<double> mesh_shares_;             ///< of each sample of the mesh, times importance
  std::vector<SkinPatches::Coordinates> feet_;  ///< of each vertex
  std::array<std::vector<SkinPatches::Coordinates>, 4> edge_feet_;
  double skin_rms_ = 0;
};

}  // namespace mammotwin
