#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// A column of a breast's region has as much [mm]: elements stand on it.
inline constexpr double least_tissue_mm = 5;
/// Smaller pieces of muscle are vessels or noise.
inline constexpr double least_muscle_ml = 2;

/// Tissue in front of the muscle along antero-posterior columns, one value a column (i, k) of the
/// labels, i fastest. A column's tissue reaches from the skin to the first muscle, or to the last
/// labelled voxel where there is no muscle; pieces of muscle of less than
/// `least_muscle_ml` are none.
struct TissueColumns {
  int nx = 0, nz = 0;
  std::vector<double> tissue;   ///< [mm]
  std::vector<double> front;    ///< how far forward (-y) the skin reaches [mm]; -infinity: empty
  std::vector<char> on_muscle;  ///< 1: there is muscle behind the tissue, or muscle alone

  std::size_t at(int i, int k) const { return static_cast<std::size_t>(k) * nx + i; }
};

TissueColumns measure_columns(const Volume<std::uint8_t>& labels);

/// Where the muscle's front lies nearer to the skin than `least_mm`, in the columns that a region
/// holds, it is set back to there: what is in front becomes fat, under one voxel of skin.
void set_muscle_back(Volume<std::uint8_t>& labels, const BreastRegion& region, double least_mm);

/// Columns in the coronal plane, all ends included.
struct ColumnBox {
  int i0 = 0, i1 = 0, k0 = 0, k1 = 0;

  bool contains(int i, int k) const { return i >= i0 && i <= i1 && k >= k0 && k <= k1; }
  void hold(int i, int k);  ///< grows it as far as that column
};

}  // namespace mammotwin
