#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace mammotwin {

/// Compressed CC breasts of real patients as a principal component model of their shape (Pinto et
/// al., Med Phys 2022, 10.1002/mp.16133; data CC-BY-4.0, read from a folder and not part of this
/// project). A breast is a radius about the middle of the chest-wall edge, by angle and height; the
/// first component goes with thickness, the others vary independently.
class OutlinePopulation {
 public:
  /// Throws std::runtime_error naming the file of `folder` that is missing or has another size.
  explicit OutlinePopulation(const std::filesystem::path& folder);

  static constexpr double kThinnest_mm = 30, kThickest_mm = 90;  ///< of the model's patients

  /// The outline's radius in one direction, as the farthest of all heights.
  struct Radius {
    double mean_mm, sd_mm;
  };

  /// angle: from the depth axis [deg], -90 to 90. Throws std::invalid_argument beyond the model's
  /// thicknesses.
  Radius at(double thickness_mm, double angle_deg) const;

  /// Volume of the mean breast of that thickness in front of the chest-wall edge [ml].
  double volume_ml(double thickness_mm) const;

  /// Thickness of the mean breast with that volume, or the nearest that the model has: to what
  /// radiographers press it.
  double typical_thickness_mm(double volume_ml) const;

 private:
  /// Radii of the mean breast [mm], a row an angle, a column a height.
  Eigen::MatrixXd mean_at(double thickness_mm) const;

  Eigen::MatrixXd mean_;                     ///< [mm], a row an angle, a column a height
  std::vector<Eigen::MatrixXd> components_;  ///< [mm] for a score of 1
  Eigen::VectorXd score_mean_, score_sd_;
};

}  // namespace mammotwin
