#pragma once

#include <optional>
#include <string>
#include <vector>

#include "registration/mammogram/mammogram_header.h"
#include "registration/view/tomosynthesis_slices.h"

namespace mammotwin {

/// What patient.toml says of a tomosynthesis volume's slices in place of its header.
struct SliceOverrides {
  std::optional<double> spacing_mm, lowest_mm;
  std::optional<bool> first_at_support;
};

/// Where the slices of a header with `slices` lie. Spacing: by the positions of the first and last
/// slice, else (0018,0088), else (0018,0050). The first slice lies at the support where positions
/// go up, along `up_in_lps`, from it to the last. No header says how high the lowest slice lies: it
/// is taken to lie half a slice above the support, and a remark says so.
///
/// Throws std::runtime_error naming the key of patient.toml that replaces what the header lacks:
/// the spacing, or which end is first where positions are missing or do not lie along the beam.
TomosynthesisSlices tomosynthesis_slices(const MammogramHeader& header,
                                         const Eigen::Vector3d& up_in_lps,
                                         const std::optional<double>& thickness_mm,
                                         const SliceOverrides& overrides, const std::string& view,
                                         std::vector<std::string>& remarks);

}  // namespace mammotwin
