#pragma once

#include <vector>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// What the columns along y of one half of the chest hold: column (i, k) stands at
/// x = x0 + i step, z = z0 + k step [mm].
struct ColumnMap {
  int nx = 0, nz = 0;
  double x0 = 0, z0 = 0, step_x = 1, step_z = 1;
  std::vector<float> thickness;  ///< breast tissue in the column [mm], i fastest
  std::vector<float> front;      ///< y of its foremost tissue [mm]; +1e9 without tissue

  double x(int i) const { return x0 + i * step_x; }
  double z(int k) const { return z0 + k * step_z; }
  float& at(std::vector<float>& values, int i, int k) const { return values[k * nx + i]; }
  float at(const std::vector<float>& values, int i, int k) const { return values[k * nx + i]; }
};

/// Columns of every voxel of a label map that is breast (label::is_breast), on both sides.
ColumnMap columns_of(const Volume<std::uint8_t>& labels);

/// The breast's rectangle by the rule of the project, written a second time so that scores do
/// not rest on the program that they judge: medial plane at the valley between the apices, the
/// others 15 mm beyond the part round the apex where tissue is thicker than 0.35 of the apex's
/// column, pulled in until every column has 5 mm of tissue (8 laterally), pushed out to hold every
/// lesion. `columns` spans both sides. Throws std::runtime_error if a side has no tissue.
BreastRegion true_region(const ColumnMap& columns, Side side,
                         const std::vector<Eigen::Vector3d>& points_inside);

/// Breast tissue inside the region [ml].
double volume_ml(const ColumnMap& columns, const BreastRegion& region);

}  // namespace mammotwin
