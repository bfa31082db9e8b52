#include "solver/press/pressed_breast.h"

namespace mammotwin {

namespace {

constexpr int kContactPoints =
    12;  // a face of 27 mm passes 3 mm through an edge between 5 x 5 points

void add_contact(const CompressionProblem& problem, PressedBreast& breast) {
  breast.contact = std::make_shared<PlateContact>();
  breast.contact->points1d = kContactPoints;
  breast.contact_faces = faces_labelled(problem.mesh, FaceLabel::skin);
  const Faces cut = faces_labelled(problem.mesh, FaceLabel::cut);
  breast.contact_faces.insert(breast.contact_faces.end(), cut.begin(), cut.end());
  for (const auto& [e, face] : breast.contact_faces)
    breast.model->add_surface_potential(e, face, breast.contact, breast.contact->points1d);
}

void add_friction(const CompressionProblem& problem, PressedBreast& breast) {
  const auto& options = problem.friction;
  if (options.coefficient == 0) return;
  breast.friction =
      std::make_shared<PlateFriction>(breast.contact, options.coefficient, options.slip);
  for (const auto& [e, face] : breast.contact_faces)
    breast.model->add_surface_potential(e, face, breast.friction, breast.contact->points1d);
}

}  // namespace

PressedBreast make_pressed_breast(const CompressionProblem& problem, const SolidOptions& solid) {
  PressedBreast breast{make_breast_model(problem, solid), {}, {}, {}};
  add_contact(problem, breast);
  add_friction(problem, breast);
  if (const Eigen::Vector3d force = problem.body_force(); !force.isZero())
    breast.model->set_body_force([force](const Eigen::Vector3d&) { return force; });
  return breast;
}

MeshFile as_positioned(const CompressionProblem& problem) {
  MeshFile file = problem.mesh;
  if (!problem.pull.isZero() && !problem.prone.empty())
    file.mesh = HermiteMesh(problem.prone, file.mesh.elements());
  return file;
}

void hold_by_friction(PressedBreast& breast, const std::vector<PlateFriction::Hold>& holds,
                      const State& state, double frozen_mm) {
  if (!breast.friction) return;
  breast.friction->hold(holds, *breast.model, state, breast.contact_faces);
  if (frozen_mm > 0) breast.friction->freeze(frozen_mm, *breast.model, state, breast.contact_faces);
}

}  // namespace mammotwin
