#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

enum class Side { left, right };  ///< the patient's own left and right

/// Values in `segmentation.seg.nrrd`. Lesion number n (from 0) has label `lesion + n`.
namespace label {
inline constexpr std::uint8_t air = 0;
inline constexpr std::uint8_t skin = 1;
inline constexpr std::uint8_t fat = 2;
inline constexpr std::uint8_t fibroglandular = 3;
inline constexpr std::uint8_t muscle = 4;  ///< pectoral muscle and everything behind its front
inline constexpr std::uint8_t lesion = 10;
inline bool is_lesion(std::uint8_t value) { return value >= lesion; }
inline bool is_breast(std::uint8_t value) { return value != air && value != muscle; }
}  // namespace label

/// Volume fractions of the three interior tissues in a voxel, each in [0, 1]; they sum to 1 in
/// the breast (skin counts as fat here: its stiffness is a membrane's) and to 0 outside it.
struct Fractions {
  float fat = 0;
  float fibroglandular = 0;
  float lesion = 0;
};

/// All of a voxel to the tissue of its label (skin counts as fat); nothing outside the breast.
inline Fractions pure_fractions(std::uint8_t value) {
  if (label::is_lesion(value)) return {0, 0, 1};
  if (value == label::fibroglandular) return {0, 1, 0};
  return label::is_breast(value) ? Fractions{1, 0, 0} : Fractions{};
}

/// Rectangle in the coronal plane [mm, LPS] that bounds the breast: design "the breast".
/// Vertical (antero-posterior) cut planes at x_min, x_max, z_min, z_max.
struct BreastRegion {
  Side side = Side::left;
  double x_min = 0, x_max = 0, z_min = 0, z_max = 0;
  bool contains(const Eigen::Vector3d& x_in_lps) const {
    return x_in_lps.x() >= x_min && x_in_lps.x() <= x_max && x_in_lps.z() >= z_min &&
           x_in_lps.z() <= z_max;
  }
};

struct Lesion {
  std::string id;
  Eigen::Vector3d centroid_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  double volume_ml = 0;
};

/// What `segment` hands on: labels and fractions on one grid, the region, landmarks.
struct Segmentation {
  Volume<std::uint8_t> labels;
  Volume<Fractions> fractions;
  BreastRegion region;
  std::vector<Lesion> lesions;
  Eigen::Vector3d nipple_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
};

}  // namespace mammotwin
