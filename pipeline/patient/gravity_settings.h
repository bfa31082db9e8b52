#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// How the patient lies or stands, and so where gravity pulls.
enum class Pose { prone, supine, standing, none };

std::string name_of(Pose pose);

/// Acceleration in patient LPS [mm/s²]: prone pulls forward, supine back, standing to the feet.
Eigen::Vector3d gravity_in_lps(Pose pose);

/// What patient.toml says of gravity.
struct GravitySettings {
  std::optional<Pose> imaged;       ///< not given: Patient::imaged_pose
  double density_kg_per_m3 = 1000;  ///< of breast tissue: fat 920, fibroglandular 1035
  std::optional<std::filesystem::path> second_state;  ///< the same breast in another pose
  Pose second_gravity = Pose::supine;
  /// Roundness free of load of a breast that a coil pressed; 0: as it is. Not given:
  /// release_from_coil judges by the image.
  std::optional<double> coil_roundness;

  double density() const { return density_kg_per_m3 * 1e-9; }  ///< [kg/mm³]
};

void declare_gravity(Settings& settings, GravitySettings& gravity);

}  // namespace mammotwin
