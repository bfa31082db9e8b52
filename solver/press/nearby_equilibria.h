#pragma once

#include <memory>

#include "solver/newton/assembler.h"
#include "solver/newton/cholesky.h"
#include "solver/press/compression_result.h"
#include "solver/press/plate_way.h"

namespace mammotwin {

/// The equilibria next to one that `compress_from` found, to first order in what the problem
/// changes by: with q any number that it depends on,
///
///   dx/dq = -K⁻¹ ∂r/∂q
///
/// where r is the residual at the fixed state and K its derivative there, factored once, both with
/// the pressures eliminated. Plates stand where `compress_from` would put them. Friction holds with
/// the contact pressures of the state, exact where it is frozen; a paddle's spring is left out.
class NearbyEquilibria {
 public:
  /// A step from the equilibrium, with the plates as they then stand.
  struct Step {
    std::vector<HermiteMesh::Node> nodes;  ///< change of nodal parameters [mm]
    PlacedPlates from, to;
  };

  /// Throws as `compress_from` does; `near` must be the solution of `problem`.
  NearbyEquilibria(const CompressionResult& near, const CompressionProblem& problem,
                   const CompressionOptions& options);

  /// False where K is not positive definite: the equilibrium is not stable, and no step is known.
  bool usable() const { return usable_; }

  /// From the problem `from` to the problem `to`: -K⁻¹ (r_to - r_from). With `from` and `to` on
  /// either side of the problem solved it is a central difference of r.
  Step step(const CompressionProblem& from, const CompressionProblem& to) const;

 private:
  /// A problem at the solved state.
  struct Posed;
  Posed posed(const CompressionProblem& problem) const;

  CompressionResult near_;
  CompressionOptions options_;
  State state_;
  std::shared_ptr<const Posed> here_;
  std::shared_ptr<Assembler> assembler_;  ///< of the problem solved, at its state
  std::shared_ptr<Cholesky> factor_;
  bool usable_ = false;
};

}  // namespace mammotwin
