#pragma once

#include <array>

#include "pipeline/synthesize/breast_shape.h"
#include "pipeline/synthesize/lattice_noise.h"
#include "pipeline/synthesize/torso.h"
#include "pipeline/synthesize/true_region.h"

namespace mammotwin {

/// Outside and chest wall of a patient: the torso and both breasts in one skin, with fillets
/// (inframammary fold, sternal valley) where they meet and a gentle irregularity all over.
class Chest {
 public:
  /// Finds the size of the breasts that gives `options.volume_ml`. Throws std::invalid_argument
  /// if no size does.
  explicit Chest(const AnatomyOptions& options);

  /// Signed distance to the skin's outside, of first order near it [mm]; negative inside.
  double outside(const Eigen::Vector3d& x) const;
  double chest_wall(const Eigen::Vector3d& x) const { return torso_.chest_wall(x); }
  double nipple(const Eigen::Vector3d& x) const;           ///< to the nearer of both pegs
  double without_nipples(const Eigen::Vector3d& x) const;  ///< `outside`, were there none

  const Torso& torso() const { return torso_; }
  const BreastShape& breast(Side side) const { return breasts_[static_cast<int>(side)]; }
  const Nipple& nipple(Side side) const { return nipples_[static_cast<int>(side)]; }

  /// Breast tissue by columns 3 mm apart, both sides.
  ColumnMap columns() const;
  double front_y() const;  ///< y of the foremost point of both [mm]

 private:
  void shape_breasts(const AnatomyOptions& options, double scale);
  BreastShape shape_breast(const AnatomyOptions& options, Side side, double scale) const;
  Nipple place_nipple(const BreastShape& breast, std::uint64_t seed) const;

  Torso torso_;
  LatticeNoise broad_, fine_;
  std::array<BreastShape, 2> breasts_;
  std::array<Nipple, 2> nipples_;
};

}  // namespace mammotwin
