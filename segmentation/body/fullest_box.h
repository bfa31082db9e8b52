#pragma once

#include <vector>

#include "segmentation/body/tissue_columns.h"

namespace mammotwin {

struct FullestBoxRules {
  Side side = Side::left;
  double least_mm = least_tissue_mm;  ///< in every column
  double least_lateral_mm = 8;        ///< in those of the lateral edge
};

/// Of all boxes within `within` that hold the column (i, k) and no column with too little tissue,
/// the one with the largest sum of `worth` (one value a column, none negative). Found by looking at
/// all pairs of lower and upper edges: between them the sides go as far as the nearest poor column.
/// The column itself is the box where even that is poor.
ColumnBox fullest_box(const TissueColumns& columns, const std::vector<double>& worth,
                      const ColumnBox& within, int i, int k, const FullestBoxRules& rules);

}  // namespace mammotwin
