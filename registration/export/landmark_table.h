#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "registration/carry/ray_curve.h"
#include "registration/prediction/project_lesions.h"

namespace mammotwin {

/// A point that somebody has found in the MRI and in mammograms; what was not found is empty.
struct LandmarkPair {
  std::string name;
  std::optional<Eigen::Vector3d> mri_in_lps;     ///< [mm]
  std::map<std::string, Eigen::Vector2d> marks;  ///< view -> (column, row)
};

/// Reads `name,mri_l_mm,mri_p_mm,mri_s_mm,cc_column,cc_row,mlo_column,mlo_row`, any cell but the
/// name left empty. Throws std::runtime_error naming file, line and column.
std::vector<LandmarkPair> read_landmark_pairs(const std::filesystem::path& path);

/// Distances between predicted and true places of landmarks [mm].
struct TargetErrors {
  std::vector<double> with_model, without_model;
};

/// What is needed to judge one view.
struct JudgedView {
  const ViewProjection* projection;
  const ViewRays* rays;
};

/// Per view ("cc", "mlo"): from the MRI, on the detector. Under "3d": from the marks of two views,
/// in the MRI; without the model, the same two rays through the baseline's affine maps. Views need
/// a pixel grid.
std::map<std::string, TargetErrors> target_errors(const std::vector<LandmarkPair>& pairs,
                                                  const std::map<std::string, JudgedView>& views);

/// Mean, standard deviation (n - 1), median, 95th percentile and number of errors as text, one line
/// a view and prediction, for a terminal.
std::string target_error_table(const std::map<std::string, TargetErrors>& errors);

}  // namespace mammotwin
