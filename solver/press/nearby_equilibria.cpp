#include "solver/press/nearby_equilibria.h"

#include <stdexcept>
#include <utility>

#include "solver/press/pressed_breast.h"

namespace mammotwin {

/// A breast and its plates, as they are for a problem.
struct NearbyEquilibria::Posed {
  PressedBreast breast;
  PlacedPlates plates;
};

NearbyEquilibria::NearbyEquilibria(const CompressionResult& near, const CompressionProblem& problem,
                                   const CompressionOptions& options)
    : near_(near), options_(options), state_{near.deformed, near.pressure} {
  if (near.deformed.size() != static_cast<std::size_t>(problem.mesh.mesh.num_nodes()))
    throw std::invalid_argument("the result to start from belongs to another mesh");
  near_.fields.clear();
  here_ = std::make_shared<Posed>(posed(problem));
  const PressedBreast& breast = here_->breast;
  assembler_ = std::make_shared<Assembler>(*breast.model, *breast.dofs);
  assembler_->linearise(state_, {});
  factor_ = std::make_shared<Cholesky>(assembler_->pattern(), breast.dofs->node_of_equation());
  usable_ = factor_->factor(assembler_->matrix());
}

NearbyEquilibria::Posed NearbyEquilibria::posed(const CompressionProblem& problem) const {
  Posed posed{make_pressed_breast(problem, options_.solid), {}};
  const MeshFile positioned = as_positioned(problem);
  const PlateFrame frame(positioned, problem.plates);
  const PlacedPlates asked =
      PlateWay(frame, problem, options_.moving).at(1, problem.plates.paddle_tilt);
  const double apart = near_.plates.paddle_height - near_.plates.support_height +
                       problem.plates.thickness - near_.report.target_thickness_mm;
  posed.plates =
      frame.place(asked.support_height, asked.support_height + apart, problem.plates.paddle_tilt);
  posed.breast.contact->plates = {posed.plates.support, posed.plates.paddle};
  posed.breast.contact->penalty = near_.penalty;
  hold_by_friction(posed.breast, near_.holds, state_, options_.frozen_friction);
  return posed;
}

NearbyEquilibria::Step NearbyEquilibria::step(const CompressionProblem& from,
                                              const CompressionProblem& to) const {
  if (!usable_) throw std::logic_error("no step from an equilibrium that is not stable");
  const Posed a = posed(from), b = posed(to);
  const Eigen::VectorXd change = factor_->solve(
      assembler_->change_of_right_hand_side(*a.breast.model, *b.breast.model, state_));
  return {assembler_->nodal_step(change, {}), a.plates, b.plates};
}

}  // namespace mammotwin
