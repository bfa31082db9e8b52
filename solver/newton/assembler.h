#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/newton/dof_map.h"
#include "solver/newton/model.h"
#include "solver/newton/sparse_pattern.h"

namespace mammotwin {

/// How far a state is from equilibrium.
struct Balance {
  double energy = 0;  ///< total potential [mN mm]; infinite where an element is inverted
  double min_J = 1, max_J = 1;
  double deformed_volume = 0;  ///< [mm³]
  double flow = 0;           ///< √Σ|element residual|², at least that of a strain of 1e-3 [mN]
  double constraint = 0;     ///< largest |∫ψ (J − 1 − p/κ)| / element volume [-]
  Eigen::VectorXd residual;  ///< ∂Π/∂x per equation [mN]

  // What the condensed energy is made of (condensed_energy.h); it does not depend on the pressures.
  double stored = 0;     ///< of all but the pressures' terms [mN mm]
  double magnitude = 0;  ///< sum of the elements' absolute energies: what rounding is of
  Eigen::MatrixXd swelling;  ///< 8 x elements, s = L⁻¹ ∫ψ (J − 1), where ∫ψψᵀ/κ = L Lᵀ [√(mN mm)]
};

/// Pressures after a linear step, and what the condensed energy's slope needs of it.
struct PressureStep {
  std::vector<double> pressure;  ///< p after the step [kPa]
  Eigen::MatrixXd now, after;    ///< 8 x elements: Lᵀp before and after the step [√(mN mm)]
  Eigen::MatrixXd rate;          ///< 8 x elements: change of `swelling`, linearised [√(mN mm)]
};

/// Sums the elements of a model into the equations of a DofMap: in parallel, in an order that does
/// not depend on threads. Pressures are eliminated element by element in the linear algebra only.
class Assembler {
 public:
  Assembler(const Model& model, const DofMap& dofs);

  const SparsePattern& pattern() const { return pattern_; }
  int num_equations() const { return pattern_.num_columns(); }

  Balance balance(const State& state) const;

  /// Fills matrix() and right_hand_side() with the condensed tangent and residual. `pending` are
  /// increments of prescribed dofs that this linear step makes too (empty: none).
  Balance linearise(const State& state, const std::vector<HermiteMesh::Node>& pending,
                    TangentKind kind = TangentKind::exact);
  const std::vector<double>& matrix() const { return values_; }
  /// The μ-weighted Laplacian of all three components, in the same pattern.
  const std::vector<double>& metric();
  const Eigen::VectorXd& right_hand_side() const { return right_hand_side_; }

  /// Increment of every node for a solution of the linearised system, prescribed ones included.
  std::vector<HermiteMesh::Node> nodal_step(const Eigen::VectorXd& solution,
                                            const std::vector<HermiteMesh::Node>& pending) const;

  /// Pressures after the step whose nodal increments these are.
  PressureStep pressures_after(const State& state,
                               const std::vector<HermiteMesh::Node>& step) const;

  /// Right-hand side that takes an excess of swelling (8 x elements) away again, with the couplings
  /// of the last linearise().
  Eigen::VectorXd against_swelling(const Eigen::MatrixXd& excess) const;

  /// How much of the right-hand side changes between two models of this mesh and these unknowns at
  /// the state of the last linearise(), where that is balanced: its couplings eliminate the
  /// pressures of both.
  Eigen::VectorXd change_of_right_hand_side(const Model& from, const Model& to,
                                            const State& state) const;

  /// Takes the unsymmetric part of the tangent at a state, and its product with a solution.
  void take_circulation(const State& state);
  Eigen::VectorXd circulation(const Eigen::VectorXd& solution) const;

  /// Residual of every nodal parameter, prescribed ones included: reactions [mN].
  std::vector<HermiteMesh::Node> nodal_residual(const State& state) const;

 private:
  struct Elimination {  ///< of one element's pressures
    Eigen::Matrix<double, kUnknowns, 8> coupling;
    Eigen::Matrix<double, 8, 1> residual;
  };
  void condense(int e, const Eigen::Matrix<double, kUnknowns, 1>& pending, ElementSystem& system);
  void scatter(int e, const Eigen::MatrixXd& tangent, std::vector<double>& values) const;
  Eigen::Matrix<double, kUnknowns, 1> gather(int e, const std::vector<HermiteMesh::Node>& x) const;
  Eigen::Map<const Eigen::VectorXd> pressures_of(const State& state, int e) const;
  Balance part_of(int e, const State& state, const ElementSystem& system) const;
  Balance summarise(const std::vector<Balance>& parts) const;

  const Model& model_;
  SparsePattern pattern_;
  std::vector<Eigen::MatrixXd> pressure_factors_;  ///< L⁻¹ of ∫ψψᵀ/κ = L Lᵀ, per element
  std::vector<Eigen::MatrixXd> pressure_scales_;   ///< Lᵀ
  std::vector<Elimination> eliminations_;
  std::vector<std::vector<Model::FaceCirculation>> circulations_;  ///< per element
  std::vector<double> values_, metric_;                            ///< metric_ is made when needed
  double smallest_flow_ = 0;
  Eigen::VectorXd right_hand_side_;
};

}  // namespace mammotwin
