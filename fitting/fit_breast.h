#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fitting/mesh/mesh_file.h"
#include "fitting/surface/triangle_surface.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

using FitProgress = std::function<void(double fraction, const std::string& what)>;

struct FitOptions {
  /// Along x, z and from chest wall to skin, 1 to 16 each. Default: elements_for() the skin's area,
  /// and up to 2 columns more where the skin is too uneven for that.
  std::optional<Eigen::Vector3i> elements;
  /// Skin RMS, worse direction, 0.05 to 5 [mm]: with it the columns along x and z are as few of 4
  /// to 12 as reach it. Labels of 1 mm are rough by 0.25 mm themselves.
  std::optional<double> accuracy_mm;
  /// Weight of ∫ Σᵢⱼ |∂²x/∂uᵢ∂uⱼ|² du over u in [0,1]³ against mean squared distances [mm²],
  /// 1e-12 to 1e-3. Default: from the data's noise, 1e-8 (noise / 0.29 mm)².
  std::optional<double> smoothing;
  /// Weight of the mean foldover-free energy against the same, 0.1 to 10. Lower follows the skin
  /// closer with worse shaped elements.
  double shape = 0.3;
  /// Of Ceres in all stages together, steps that were refused included, 1 to 10,000.
  int max_iterations = 200;
  /// What mammotwin-fit says of them: 0 nothing, 1 a line an iteration, 2 Ceres' full reports, too.
  int verbosity = 0;
};

/// The default elements for a skin of this area.
Eigen::Vector3i elements_for(double skin_area_mm2);

/// A skin that was scanned, in the segmentation's frame.
struct ScannedSkin {
  TriangleSurface surface;  ///< without holes, beyond the region on all sides [mm]
  double noise_mm = 0;      ///< standard deviation of its points
};

enum class StepOutcome { accepted, refused_by_cost, refused_by_proof };

/// One iteration of Ceres.
struct FitIteration {
  std::string stage;
  StepOutcome outcome = StepOutcome::accepted;
  double cost = 0;         ///< that is left [mm²]; its weights differ by stage
  double skin_rms_mm = 0;  ///< that is left, smoothed data to mesh
  double radius = 0;       ///< of the trust region for the next step
};

/// Distances are to the label boundary without any smoothing, all of it inside the region.
struct FitReport {
  std::string status = "refused";    ///< ok, look, refused or not_converged
  std::vector<std::string> reasons;  ///< sentences; empty when ok
  Eigen::Vector3i elements = Eigen::Vector3i::Zero();
  double noise_mm = 0;   ///< standard deviation of the data
  double smoothing = 0;  ///< the weight that was used
  double skin_rms_mesh_to_data_mm = 0;
  double skin_rms_data_to_mesh_mm = 0;
  double skin_p95_mm = 0;         ///< the larger of both directions
  double skin_max_mm = 0;         ///< the larger of both directions
  double nipple_error_mm = 0;     ///< largest within 15 mm of the nipple, both directions
  double chest_wall_rms_mm = 0;   ///< labelled muscle front to the mesh
  double min_jacobian_bound = 0;  ///< det(∂x/∂ξ) is at least this fraction of its mean, proved
  double min_scaled_jacobian = 0;           ///< smallest over 7³ points an element
  double covered_fraction = 0;              ///< of the breast's voxels in the region
  double covered_lesions = 1;               ///< of the lesions' voxels, in the region or not
  int iterations = 0;                       ///< of Ceres, refused steps included
  std::vector<FitIteration> course;         ///< of the mesh that is given; each stage's start, too
  std::vector<std::string> solver_reports;  ///< Ceres' own, one a call
  Eigen::Vector3d farthest_in_lps = Eigen::Vector3d::Zero();  ///< where skin_max_mm was met
  bool usable() const { return status == "ok" || status == "look"; }
};

struct FitResult {
  MeshFile mesh;
  FitReport report;
};

/// Skin and chest wall of a labelled breast as a slab of tri-cubic Hermite elements whose
/// det(∂x/∂ξ) > 0 is proved (fitting/README.md says how). ξ₁ runs with x (to the patient's
/// left), ξ₂ with z (up), ξ₃ from chest wall to skin.
///
/// Throws std::invalid_argument for options out of range and std::runtime_error, saying what to
/// look at, where labels hold no breast or its skin cannot be laid on a square. Where no valid
/// mesh was found the report says not_converged and the mesh has no elements.
/// With `scan`, distances go to that skin and not to the labels'.
FitResult fit_breast(const Segmentation& segmentation, const FitOptions& options,
                     const FitProgress& progress = {}, const ScannedSkin* scan = nullptr);

}  // namespace mammotwin
