#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/cases/real_breasts.h"

namespace mammotwin {

/// What a breast does from prone to supine, as it is counted in women imaged in both poses.
struct SupineMoves {
  Eigen::Vector3d nipple = Eigen::Vector3d::Zero();  ///< lateral, posterior, superior [mm]
  double landmark_mm = 0;                            ///< median over points in the tissue
  double ribs_prone_mm = 0, ribs_supine_mm = 0;      ///< the points' medians
};

/// `unloaded`: a mesh with its configurations "prone" and "supine". The points are 500 of the prone
/// tissue, the same at each call, uniform in volume where it lies 10 to 60 mm from the ribs; these
/// lie 6 mm behind the chest wall of the mesh, which is the front of the muscle.
/// Throws std::runtime_error where a configuration is missing or no tissue lies so.
SupineMoves supine_moves(const MeshFile& unloaded, Side side, const Eigen::Vector3d& nipple_in_lps);

/// One breast segmented, fitted, unloaded and laid on its back in `folder`, by the stages'
/// commands; `unload_options` are given to the last one. `cpu_seconds` are of unloading. What fails
/// leaves its figures null and says why.
nlohmann::json gravity_row(const RealBreast& breast, const std::filesystem::path& folder,
                           const std::vector<std::string>& unload_options);

}  // namespace mammotwin
