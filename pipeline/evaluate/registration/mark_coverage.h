#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// A predicted mark with what was said of its uncertainty.
struct JudgedMark {
  bool lesion = false;                            ///< else a point of gland
  Eigen::Vector2d off = Eigen::Vector2d::Zero();  ///< true mark from the predicted one [mm]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< that was stated [mm^2]
  bool in_image = true;                                      ///< the true mark
};

nlohmann::json mark_json(const JudgedMark& mark);
JudgedMark mark_of(const nlohmann::json& mark);

/// How honest and how large the ellipses of these marks are. Null where there are none.
///   inside_50, inside_90   fractions of the marks inside their ellipse of that probability
///   major_50_mm, major_90_mm   medians of the semi-major axes
///   median_error_mm        of the marks, on the detector
nlohmann::json coverage_of(const std::vector<JudgedMark>& marks);

/// The same for the marks of all patients together, as lines for a terminal: fractions with their
/// standard error from patient to patient, for marks of one patient are wrong together.
std::string coverage_summary(const std::vector<std::vector<JudgedMark>>& patients);

}  // namespace mammotwin
