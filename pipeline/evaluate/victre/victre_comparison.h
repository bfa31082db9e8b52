#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate/niftysim/half_ball_mesh.h"

namespace mammotwin {

struct VictreComparison {
  /// Overlap of breast and gland, distance of the outlines, each for our solution and, as
  /// `uncompressed_`, for doing nothing; and the compression's own figures.
  nlohmann::json figures;
  std::string reason;  ///< why there is no equilibrium; empty where there is
};

/// Compresses VICTRE's phantom `p_1` of `folder` with our solver to the thickness of `pc_1`, which
/// FEBio compressed, and compares the labels.
VictreComparison compare_with_victre(const std::filesystem::path& folder,
                                     const HalfBallElements& elements);

}  // namespace mammotwin
