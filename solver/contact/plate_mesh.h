#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

#include "solver/contact/plate.h"

class vtkPolyData;

namespace mammotwin {

/// A plate of any shape, from facets in its own frame: x from the chest-wall edge towards the
/// nipple, z out of the plate into the tissue, y = z × x; x = 0 at the edge, y = 0 at the breast's
/// middle, z = 0 at the height that the plate is placed by [mm]. Facets are counter-clockwise seen
/// from outside; they need not close.
///
/// Newton needs a gap with two derivatives, which facets do not have. So their signed distance is
/// sampled on a grid of spacing h and carried by cubic B-splines (the quasi-interpolant
/// c = f − δ²f/6 along each axis, which reproduces cubics): twice continuously differentiable,
/// exact on flat parts, fourth order on curved ones; a sharp edge is rounded over about h. Facets
/// that face down are left out and the plate goes on below them, so that tissue which a soft
/// penalty lets deep inside comes out again through the face.
class PlateMesh {
 public:
  /// Throws std::invalid_argument that names the file and what is wrong: missing, no facets, too
  /// many, a size that is not a plate's in mm, facets that face away from the tissue.
  static PlateMesh read(const std::filesystem::path& stl);

  /// Beyond the grid (10 mm and more from the facets) not in contact, without derivatives.
  Gap gap(const Eigen::Vector3d& x_local) const;

  const Eigen::Vector3d& low() const { return low_; }  ///< corners of the facets' box [mm]
  const Eigen::Vector3d& high() const { return high_; }
  double spacing() const { return spacing_; }  ///< h [mm]

 private:
  void sample(vtkPolyData& facets);
  void make_coefficients();
  Gap smoothed(const Eigen::Vector3d& x_local) const;
  double at(int i, int j, int k) const { return distance_[i + size_[0] * (j + size_[1] * k)]; }

  Eigen::Vector3d low_, high_, origin_;
  double spacing_ = 0;
  double floor_ = 0;  ///< below it the gap grows with depth alone
  std::array<int, 3> size_;
  std::vector<double> distance_;  ///< samples, then coefficients
};

}  // namespace mammotwin
