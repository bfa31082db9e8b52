#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "fitting/scan/scanned_breast.h"

namespace mammotwin {

/// The model made from the scan beside the true breast: the same gel inside the skin of the
/// formula, on a refined mesh.
struct GelBreastState {
  double compressed_fraction = 0;  ///< of the free extent along the beam, asked
  bool reached = false;            ///< on both meshes
  std::string reason;              ///< why not
  double thickness_mm = 0;
  double force_N = 0, true_force_N = 0;
  double to_true_rms_mm = 0;  ///< skin to skin, the larger of both directions
  /// Cleaned points of a scan of the true skin (noise 0.3 mm), as it then is, to the model's.
  double to_scan_rms_mm = 0;
  double outline_rms_mm = 0;  ///< from the camera beside the patient (side_outline)
  double outline_max_mm = 0;
  double seconds = 0, true_seconds = 0;
  MeshFile mesh{HermiteMesh({}, {}), {}, {}, {}, {}, {}};  ///< the model's
  std::vector<Eigen::Vector3d> scan;                       ///< cleaned
};

/// The gel breast fitted to its scan and pressed in CC to 0.75 and 0.5 of its free extent.
struct GelBreastResult {
  FitReport fit, true_fit;
  int dof = 0, true_dof = 0;
  std::vector<GelBreastState> states;  ///< as scanned (0), then compressed; empty without a mesh
};

/// Elements of the model's mesh, the fit's default for a scan, and of the true breast's. With 7x7x2
/// the model is 0.35 mm off between the plates.
struct GelBreastMeshes {
  Eigen::Vector3i model{9, 9, 2};
  Eigen::Vector3i truth{12, 12, 2};
};

/// `say` is told what is being done.
GelBreastResult run_gel_breast(const std::filesystem::path& scan, const GelBreastMeshes& meshes,
                               const std::vector<double>& compressed_fractions,
                               const std::function<void(const std::string&)>& say);

nlohmann::json to_json(const GelBreastResult& result);

/// A sentence for every state that misses 0.3 mm, or that was not reached.
std::vector<std::string> missed_targets(const GelBreastResult& result);

}  // namespace mammotwin
