#pragma once

#include <vector>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// Posterior coordinate y(x, z) [mm, LPS] of the chest wall over the columns of a label volume,
/// bilinear between column centres and constant beyond them.
class HeightField {
 public:
  HeightField() = default;
  HeightField(const Volume<std::uint8_t>& grid, std::vector<double> heights);

  double operator()(double x, double z) const;

  /// ∂y/∂x and ∂y/∂z, by differences over a column's width.
  Eigen::Vector2d slope(double x, double z) const;

  double at(int i, int k) const { return heights_[i + static_cast<std::size_t>(size_x_) * k]; }

 private:
  int size_x_ = 0, size_z_ = 0;
  double origin_x_ = 0, origin_z_ = 0, spacing_x_ = 1, spacing_z_ = 1;
  std::vector<double> heights_;
};

/// The front of the muscle inside the region.
struct MuscleFront {
  /// Smoothed (median over 9 x 9 columns, then Gaussian of 2 mm), then pushed back to hold every
  /// lesion: a tumour that has grown into the muscle lies in a pit with slopes of 1.5.
  HeightField height;
  /// Centres of the front faces of the first muscle voxels in the region [mm, LPS], as labelled.
  std::vector<Eigen::Vector3d> labelled;
};

/// Columns without muscle: gaps that do not reach the region's border are interpolated (a tumour
/// on the pectoral muscle leaves such pits), others take the end of the tissue. Pieces of muscle
/// of less than `least_muscle_ml` are ignored.
MuscleFront find_muscle_front(const Volume<std::uint8_t>& labels, const BreastRegion& region);

}  // namespace mammotwin
