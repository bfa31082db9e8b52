#pragma once

#include <Eigen/Core>

#include "pipeline/synthesize/lattice_noise.h"
#include "pipeline/synthesize/options.h"

namespace mammotwin {

/// What lies behind the front of the pectoral muscle.
enum class Organ { muscle, rib, lung, heart, liver };

inline constexpr double rib_mm = 8;         ///< depth of ribs and what lies between them
inline constexpr double rib_pitch_mm = 27;  ///< along the body
inline constexpr double sternum_half_mm = 17;

/// The chest without breasts: a rib cage that is an ellipse in every axial plane and narrows
/// towards the head, pectoral muscles on it with a lateral cusp, fat and skin. LPS [mm]; the
/// sternal skin is at y = 0 where z = 0, the nipples are near z = 0.
///
/// Distances are signed, negative inside or behind, and true to first order near their zero.
class Torso {
 public:
  explicit Torso(const AnatomyOptions& options);

  double rib_cage(const Eigen::Vector3d& x) const;    ///< to the outside of the ribs
  double chest_wall(const Eigen::Vector3d& x) const;  ///< to the front of the muscle
  double skin(const Eigen::Vector3d& x) const;        ///< to the skin, were there no breasts
  Organ organ(const Eigen::Vector3d& x) const;        ///< of a point behind the chest wall

  /// y of the chest wall at (x, z) [mm].
  double wall_y(double x, double z) const;

 private:
  double flank_muscle(double x) const;
  double cusp_x(double z) const;  ///< lateral border of the pectoral, further out towards the arm
  double muscle_thickness(double x, double z) const;
  double padding(double x, double z) const;
  bool in_heart(const Eigen::Vector3d& x) const;
  bool in_liver(const Eigen::Vector3d& x) const;

  double half_width_, half_depth_, centre_y_;
  double pectoral_, subcutaneous_;
  LatticeNoise ripple_, lung_vessels_;
};

}  // namespace mammotwin
