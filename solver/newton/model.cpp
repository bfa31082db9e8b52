#include "solver/newton/model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/element/element_coefficients.h"

namespace mammotwin {

namespace {

SolidElement make_element(const HermiteMesh& mesh, int e) {
  const auto X = element_coefficients(mesh, mesh.nodes(), e);
  if (!X.allFinite())
    throw std::invalid_argument("element " + std::to_string(e) +
                                " has a nodal parameter that is not a finite number");
  try {
    return SolidElement(X);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("element " + std::to_string(e) + ": " + error.what());
  }
}

}  // namespace

Model::Model(const HermiteMesh& reference, const MaterialField& field, const SolidOptions& options)
    : reference_(reference) {
  if (num_elements() == 0) throw std::invalid_argument("the mesh has no elements");
  faces_.resize(num_elements());
  potentials_.resize(num_elements());
  for (int e = 0; e < num_elements(); ++e) {
    SolidElement element = make_element(reference_, e);
    SolidElement::Materials materials;
    for (int q = 0; q < kPoints; ++q)
      materials[q] = field(element.point_position(q), element.point_weight(q));
    element.set_materials(materials, options);
    elements_.push_back(std::move(element));
  }
}

void Model::add_surface_potential(int e, int face, std::shared_ptr<const SurfacePotential> p,
                                  int points1d) {
  auto& faces = faces_[e];
  auto found = std::find_if(faces.begin(), faces.end(), [&](const Face& f) {
    return f.face() == face && f.points1d() == points1d;
  });
  if (found == faces.end()) {
    faces.emplace_back(e, face, element_coefficients(reference_, reference_.nodes(), e), points1d,
                       num_surface_points_);
    num_surface_points_ += points1d * points1d;
    found = faces.end() - 1;
  }
  potentials_[e].push_back({static_cast<int>(found - faces.begin()), std::move(p)});
}

void Model::set_body_force(const std::function<Eigen::Vector3d(const Eigen::Vector3d& X)>& force) {
  loads_.clear();
  for (const SolidElement& element : elements_) loads_.push_back(element.integrate(force));
}

void Model::set_dead_forces(DeadForces forces) { dead_forces_ = std::move(forces); }

State Model::rest() const {
  return {reference_.nodes(), std::vector<double>(8 * num_elements(), 0.0)};
}

double Model::volume() const {
  double volume = 0;
  for (const auto& element : elements_) volume += element.volume();
  return volume;
}

SolidElement::Coefficients Model::coefficients(const std::vector<HermiteMesh::Node>& x,
                                               int e) const {
  return element_coefficients(reference_, x, e);
}

void Model::evaluate(int e, const State& state, TangentKind kind, ElementSystem& system) const {
  const auto x = element_coefficients(reference_, state.x, e);
  elements_[e].evaluate(x, state.pressure.data() + 8 * e, kind, system);
  if (!std::isfinite(system.energy)) return;  // J <= 0: nothing else is defined
  for (const auto& [face, potential] : potentials_[e])
    faces_[e][face].add(*potential, x, kind, system);
  const auto add = [&](const SolidElement::Coefficients& forces, double share) {
    system.energy -= share * forces.cwiseProduct(x).sum();
    system.residual -= share * forces.reshaped();
  };
  if (!loads_.empty()) add(loads_[e], 1);
  if (!dead_forces_.empty()) add(dead_forces_[e], dead_share_);
}

std::vector<Model::FaceCirculation> Model::circulations(int e, const State& state) const {
  const auto x = element_coefficients(reference_, state.x, e);
  std::vector<FaceCirculation> all;
  for (const auto& [face, potential] : potentials_[e]) {
    FaceCirculation part{&faces_[e][face], Face::Circulation::Zero()};
    if (part.face->add_circulation(*potential, x, part.block)) all.push_back(std::move(part));
  }
  return all;
}

void Model::evaluate_reference(int e, const State& state, const Eigen::Vector3d& body_force,
                               ReferenceSystem& system) const {
  const auto x = element_coefficients(reference_, state.x, e);
  elements_[e].evaluate_reference(x, state.pressure.data() + 8 * e, body_force, system);
  for (const auto& [face, potential] : potentials_[e])
    faces_[e][face].add_reference(*potential, x, system);
}

}  // namespace mammotwin
