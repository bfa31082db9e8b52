#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "fitting/mesh/hermite_mesh.h"
#include "solver/element/dead_forces.h"
#include "solver/element/face.h"
#include "solver/element/solid_element.h"
#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Unknowns: nodal parameters of the deformed shape and the elements' pressures.
struct State {
  std::vector<HermiteMesh::Node> x;  ///< [mm]
  std::vector<double> pressure;      ///< 8 an element, the first `num_pressures` in use [kPa]
};

/// Index of component i of nodal parameter d of a node.
constexpr int dof_index(int node, int parameter, int component) {
  return 24 * node + 3 * parameter + component;
}

/// A body: elements with tissue, and potentials on their faces. Everything that stores energy.
class Model {
 public:
  /// Tissue as a function of reference position [mm] and the volume that the point stands for
  /// [mm³].
  using MaterialField =
      std::function<std::shared_ptr<const Material>(const Eigen::Vector3d& X, double volume)>;

  /// Throws std::invalid_argument that names the element where the mesh is folded or not finite.
  Model(const HermiteMesh& reference, const MaterialField& materials, const SolidOptions& options);

  const HermiteMesh& reference() const { return reference_; }
  int num_elements() const { return reference_.num_elements(); }
  const SolidElement& element(int e) const { return elements_[e]; }
  const std::vector<Face>& faces(int e) const { return faces_[e]; }
  int num_surface_points() const { return num_surface_points_; }  ///< of all faces in use

  /// Puts a potential on a face with points1d x points1d Gauss points; several may share one. The
  /// model keeps it alive.
  void add_surface_potential(int element, int face, std::shared_ptr<const SurfacePotential> p,
                             int points1d = 5);

  /// Force per reference volume [mN/mm³], such as density times gravity.
  void set_body_force(const std::function<Eigen::Vector3d(const Eigen::Vector3d& X)>& force);

  void set_dead_forces(DeadForces forces);
  void set_dead_share(double share) { dead_share_ = share; }  ///< of them that acts

  State rest() const;  ///< reference shape, no pressure
  double volume() const;

  SolidElement::Coefficients coefficients(const std::vector<HermiteMesh::Node>& x, int e) const;

  /// All terms of one element at a state.
  void evaluate(int e, const State& state, TangentKind kind, ElementSystem& system) const;

  /// What potentials on one element's faces add to ∂residual/∂x that is not symmetric, face by
  /// face.
  struct FaceCirculation {
    const Face* face;
    Face::Circulation block;
  };
  std::vector<FaceCirculation> circulations(int e, const State& state) const;

  /// Derivatives of one element's residuals by the reference shape; `body_force` is the constant
  /// one that was set.
  void evaluate_reference(int e, const State& state, const Eigen::Vector3d& body_force,
                          ReferenceSystem& system) const;

 private:
  struct FacePotential {
    int face_in_element;
    std::shared_ptr<const SurfacePotential> potential;
  };
  HermiteMesh reference_;
  std::vector<SolidElement> elements_;
  std::vector<SolidElement::Coefficients> loads_;  ///< of the body force; empty: none
  DeadForces dead_forces_;
  double dead_share_ = 1;
  std::vector<std::vector<Face>> faces_;
  std::vector<std::vector<FacePotential>> potentials_;
  int num_surface_points_ = 0;
};

}  // namespace mammotwin
