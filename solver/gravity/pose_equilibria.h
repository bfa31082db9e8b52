#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/gravity/inverse_equilibrium.h"
#include "solver/newton/assembler.h"
#include "solver/newton/cholesky.h"

namespace mammotwin {

/// An imaged breast free of load and as it then lies in another pose, and how both change with the
/// problem, to first order: with X the shape free of load, x the pose and q any number that the
/// problem depends on,
///
///   dX/dq = -(∂R/∂X)⁻¹ ∂R/∂q,   dx/dq = -K⁻¹ (∂r/∂q + ∂r/∂X dX/dq)
///
/// where R and r are the residuals of the inverse and of the forward problem and K = ∂r/∂x, each
/// factored once, all with the pressures eliminated.
class PoseEquilibria {
 public:
  /// `imaged`: as `unload` takes it, with the gravity that it was imaged under. Where the imaged
  /// shape holds up to a share of its gravity only, both poses have that share.
  PoseEquilibria(const BreastProblem& imaged, const Eigen::Vector3d& pose_gravity);

  bool usable() const { return reason_.empty(); }
  const std::string& reason() const { return reason_; }  ///< why there is no equilibrium, or empty

  const std::vector<HermiteMesh::Node>& unloaded() const { return unloaded_.x; }
  const std::vector<HermiteMesh::Node>& posed() const { return posed_.x; }
  double gravity_share() const { return share_; }

  struct Step {  ///< changes of nodal parameters [mm]
    std::vector<HermiteMesh::Node> unloaded, posed;
  };
  /// From the problem `from` to the problem `to`; with the two on either side of the imaged one it
  /// is a central difference of the residuals. They may not differ in mesh or gravity.
  Step step(const BreastProblem& from, const BreastProblem& to) const;

 private:
  Eigen::VectorXd residual(const BreastProblem& problem,
                           const std::vector<HermiteMesh::Node>& unloaded) const;

  BreastProblem imaged_;
  Eigen::Vector3d image_force_, pose_force_;  ///< [mN/mm³]
  double share_ = 0;
  std::unique_ptr<InverseEquilibrium> inverse_;
  State unloaded_, posed_;
  BreastModel breast_;
  std::unique_ptr<Assembler> assembler_;
  std::unique_ptr<Cholesky> factor_;
  std::string reason_;
};

}  // namespace mammotwin
