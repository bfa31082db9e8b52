#pragma once

#include "fitting/mesh/inverse_map.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Tissue at a mesh's 4³ Gauss points an element, by counting: every voxel of breast belongs to one
/// point's cell, which along each ξ ends where the Gauss weights have summed up to it. Voxels up to
/// 5 mm behind the chest wall or before the skin belong to the nearest cell; what lies beyond the
/// mesh in x or z, its cut planes, does not count. A point's fractions are its voxels'; those of
/// cells that hold several tissues are then scaled so that all points together hold as much lesion
/// and fibroglandular tissue as the voxels (a point stands for w det ∂x/∂ξ). A cell without voxels
/// is fat.
class CellTissue {
 public:
  /// `mesh` as imaged.
  CellTissue(const HermiteMesh& mesh, const Volume<Fractions>& fractions);

  /// Fractions of the cell that holds x [mm, LPS], of the nearest one outside the mesh.
  Fractions at(const Eigen::Vector3d& x_in_lps) const;

 private:
  InverseMap map_;
  std::vector<Fractions> cells_;
};

}  // namespace mammotwin
