#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/compression/supine_points.h"

namespace mammotwin {

/// `unloaded`: a mesh with its configurations "prone" and "supine". Throws std::runtime_error where
/// one is missing.
SupineMoves supine_moves(const MeshFile& unloaded, Side side, const Eigen::Vector3d& nipple_in_lps);

/// One breast segmented, fitted, unloaded and laid on its back in `folder`, by the stages'
/// commands; `unload_options` are given to the last one. `cpu_seconds` are of unloading. What fails
/// leaves its figures null and says why.
nlohmann::json gravity_row(const RealBreast& breast, const std::filesystem::path& folder,
                           const std::vector<std::string>& unload_options);

}  // namespace mammotwin
