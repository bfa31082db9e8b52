#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "segmentation/body/breast_frame.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// Brightness of what lies on both sides of the wall.
struct WallContrast {
  double fat = 1;
  double muscle = 1.55;
  double roughness = 0;  ///< standard deviation along 5 mm of muscle; 0: not known
  double gland = 0;      ///< in front of the wall; 0: not known, or not to be told from muscle
  double spread = 0.2;   ///< of the logarithm in each: noise, texture and what bias is left
};

/// Half the angle over the breastbone: thin skin on bone, and no breast.
inline constexpr double breastbone_degrees = 12;

/// Walls that lie further apart follow different edges.
inline constexpr double other_edge_mm = 5;

/// The front of the chest wall as a radius over angle and height, round a vertical axis behind the
/// breastbone. Angle 0 points forward, positive to the patient's left.
struct PectoralWall {
  double axis_x = 0, axis_y = 0;           ///< [mm, LPS]
  double first_angle = 0, angle_step = 0;  ///< [radians]
  double first_z = 0, z_step = 0;          ///< [mm, LPS]
  int angles = 0, rows = 0;
  std::vector<double> radius;  ///< [mm], angles fastest
  std::vector<float> cost;     ///< of the wall found there; below -0.5 the image supports it
  std::vector<float> behind;   ///< mean brightness 2 to 5 mm behind it, fat = 1
  std::vector<WallContrast> contrast;  ///< around each ray
  std::vector<char> drawn;             ///< 1: a person drew it there; empty: nowhere

  /// Point of a ray (index into `radius`) at some radius [mm, LPS].
  Eigen::Vector3d position(std::size_t ray, double radius_mm) const;

  /// True if a point lies behind the front; beyond the last angle the last radius holds.
  bool is_behind(const Eigen::Vector3d& x_in_lps) const;

  /// Rays in front of one side (within 50 degrees, in the breasts' slices) where the image does not
  /// support the wall; and their share.
  std::vector<std::size_t> unsupported(Side side, double z_low, double z_high) const;
  double doubt(Side side, double z_low, double z_high) const;

  /// Of those away from the breastbone, the ones behind which it is rather as bright as fat than as
  /// muscle, by the logarithm; and their share. Sees a wall on a wrong edge, whose cost is good.
  /// Over the breastbone (12 degrees) there are but 4 mm of muscle, and bone is as bright as fat.
  std::vector<std::size_t> before_fat(Side side, double z_low, double z_high) const;
  double fat_behind(Side side, double z_low, double z_high) const;

  /// Rays in front of one side, as indices into `radius`, from some angle off the midline on; none
  /// that a person drew: those are not in question.
  std::vector<std::size_t> rays_before(Side side, double z_low, double z_high,
                                       double from_degrees = 0) const;
};

/// The rays along which a wall is looked for in an image; no radius yet.
PectoralWall wall_grid(const Volume<float>& image, const BreastFrame& frame);

struct UsualRadius;

/// Finds the front of the pectoral muscle in a bias-corrected image with fat at 1.
///
/// The radius over angle and height is found by a semi-global search over the cost of wall_cost.h,
/// twice again with the brightness that wall_contrast.h measures round the wall found before;
/// wall_refinement.h then moves it to the middle of the step that the image shows there. `usual`:
/// where the wall of each ray usually lies (wall_prior.h); empty, the image alone decides. `drawn`:
/// where a person drew it (drawn_wall.h); there it lies within the spread of what was drawn.
PectoralWall find_pectoral_wall(const Volume<float>& corrected, const Volume<std::uint8_t>& body,
                                const BreastFrame& frame, const WallContrast& contrast,
                                double stiffness, const std::vector<UsualRadius>& usual,
                                const std::vector<UsualRadius>& drawn = {});

}  // namespace mammotwin
