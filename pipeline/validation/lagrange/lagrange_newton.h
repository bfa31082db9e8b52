#pragma once

#include <Eigen/SparseCholesky>

#include "pipeline/validation/lagrange/lagrange_mesh.h"
#include "solver/newton/model.h"
#include "solver/newton/newton.h"

namespace mammotwin {

/// Newton's method on Lagrange elements with discontinuous pressures, for comparison: the element's
/// energy and contact are those of a Model over mesh.broken(X), the pressures are unknowns of
/// Newton and eliminated element by element in the linear algebra.
class LagrangeNewton {
 public:
  struct State {
    std::vector<Eigen::Vector3d> x;  ///< nodes [mm]
    std::vector<double> pressure;    ///< 8 an element [kPa]
  };

  /// `held[3 n + i]`: component i of node n stays where it is.
  LagrangeNewton(const LagrangeMesh& mesh, const Model& model, const std::vector<bool>& held);

  int num_equations() const { return num_equations_; }
  mammotwin::State hermite(const State& state) const;  ///< of mesh.broken(x)

  /// Brings the state to equilibrium; one with contact should be near it.
  NewtonReport solve(State& state, int max_iterations, double tolerance);

 private:
  struct Linear {  ///< an element's linearised pressures
    Eigen::MatrixXd coupling, compliance;
    Eigen::VectorXd residual;
  };
  struct Balance {
    double energy = 0, squared_flow = 0;
    Eigen::VectorXd residual;
  };
  Eigen::MatrixXd reduce(const Eigen::MatrixXd& columns) const;  ///< Tᵀ by component
  Balance linearise(const State& state, bool with_tangent);
  void add(int e, const ElementSystem& system, std::vector<Eigen::Triplet<double>>& entries);
  State moved(const State& from, const Eigen::VectorXd& step, double fraction) const;
  bool advance(State& state, const Balance& before);

  const LagrangeMesh& mesh_;
  const Model& model_;
  int num_equations_ = 0;
  std::vector<int> equation_;                        ///< of dof 3 n + i; -1: held
  std::vector<std::vector<int>> element_equations_;  ///< component by component
  std::vector<Linear> linear_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::VectorXd right_hand_side_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky_;
  bool analysed_ = false;
};

}  // namespace mammotwin
