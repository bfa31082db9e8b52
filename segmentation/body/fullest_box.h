#pragma once

#include <vector>

#include "segmentation/body/tissue_columns.h"

namespace mammotwin {

struct FullestBoxRules {
  Side side = Side::left;
  double least_mm = least_tissue_mm;  ///< in every column
  double least_lateral_mm = 8;        ///< in those of the lateral edge
  /// What each missing millimetre costs, of `worth`, in a column whose muscle can be set back.
  double cost_of_missing = 6;
};

/// Of all boxes within `within` that hold the column (i, k) and no column with too little tissue
/// and no muscle behind it, the one with the largest sum of `worth` (one value a column) less what
/// too little tissue on the muscle costs. Found by looking at all pairs of lower and upper edges:
/// between them each side ends where the sums of whole columns are largest. The lateral edge's
/// columns must be rich. The column itself is the box where even that is poor.
ColumnBox fullest_box(const TissueColumns& columns, const std::vector<double>& worth,
                      const ColumnBox& within, int i, int k, const FullestBoxRules& rules);

}  // namespace mammotwin
