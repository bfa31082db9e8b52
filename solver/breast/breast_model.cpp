#include "solver/breast/breast_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/element/element_coefficients.h"
#include "solver/element/skin_membrane.h"
#include "solver/load/smooth_wall.h"
#include "solver/load/spring_bed.h"
#include "solver/material/positive_modulus.h"

namespace mammotwin {

namespace {

constexpr double kSkinHoldPenalty = 10;  // x modulus/size: rigid beside tissue
constexpr double kWallPenalty = 1000;    // x modulus/size: 10 kPa moves the wall by about 0.05 mm

void check(bool good, const std::string& message) {
  if (!good) throw std::invalid_argument(message);
}

void check_problem(const BreastProblem& p) {
  check(static_cast<int>(p.mesh.faces.size()) == p.mesh.mesh.num_elements(),
        "the mesh has face labels for " + std::to_string(p.mesh.faces.size()) + " of its " +
            std::to_string(p.mesh.mesh.num_elements()) + " elements; expected all");
  check(static_cast<bool>(p.tissue), "no tissue fractions were given");
  check(p.prone.empty() || static_cast<int>(p.prone.size()) == p.mesh.mesh.num_nodes(),
        "the prone shape has " + std::to_string(p.prone.size()) + " nodes; expected " +
            std::to_string(p.mesh.mesh.num_nodes()) + ", as the mesh has");
  const auto& b = p.boundary;
  check(std::isfinite(b.chest_wall_spring) && b.chest_wall_spring >= 0,
        "chest-wall spring is " + std::to_string(b.chest_wall_spring) +
            " kPa/mm; expected at least 0");
  check(
      std::isfinite(b.cut_face_depth) && b.cut_face_depth > 0,
      "cut-face depth is " + std::to_string(b.cut_face_depth) + " mm; expected a positive length");
  check(std::isfinite(p.density) && p.density > 0 && p.gravity.allFinite(),
        "density must be positive and gravity finite");
  check(
      p.skin_forces.empty() || static_cast<int>(p.skin_forces.size()) == p.mesh.mesh.num_elements(),
      "there are skin forces for " + std::to_string(p.skin_forces.size()) + " of the mesh's " +
          std::to_string(p.mesh.mesh.num_elements()) + " elements; expected all");
}

HermiteMesh prone_mesh(const BreastProblem& problem) {
  return problem.prone.empty() ? problem.mesh.mesh
                               : HermiteMesh(problem.prone, problem.mesh.mesh.elements());
}

/// The breast as imaged: what is read at quadrature points must not depend on the shape that is the
/// reference, or unloading and loading would not meet.
struct ProneTissue {
  std::vector<std::shared_ptr<const Material>> materials;  ///< in the order in which a Model asks
  double volume = 0;                                       ///< [mm³]
};

ProneTissue prone_tissue(const BreastProblem& problem, const HermiteMesh& mesh) {
  ProneTissue tissue;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const SolidElement element(element_coefficients(mesh, mesh.nodes(), e));
    tissue.volume += element.volume();
    for (int q = 0; q < kPoints; ++q)
      tissue.materials.push_back(mix(
          problem.laws.mixing, problem.tissue(element.point_position(q), element.point_weight(q)),
          problem.laws.laws));
  }
  return tissue;
}

Model::MaterialField in_turn(std::vector<std::shared_ptr<const Material>> materials) {
  return [materials = std::move(materials), next = std::size_t{0}](
             const Eigen::Vector3d&, double) mutable { return materials[next++]; };
}

void hold_clamped(const HermiteMesh& mesh, const Faces& faces, DofMap& dofs) {
  for (const auto& [e, face] : faces)
    for (int i = 0; i < 3; ++i)
      for (int dof : face_dofs(mesh, e, face, i)) dofs.prescribe(dof);
}

double mean_modulus(const SolidElement& element) {
  double sum = 0;
  for (int q = 0; q < kPoints; ++q) sum += element.material(q).shear_modulus();
  return sum / kPoints;
}

/// Tissue fractions count skin as fat and the mesh reaches to its outside, so the solid holds fat
/// where skin is: the membrane has what skin has more.
void add_skin(const BreastProblem& problem, Model& model) {
  if (!problem.skin.on) return;
  const double c1 = positive_modulus("c1 (skin)", problem.skin.c1);
  const double c1_fat = problem.laws.laws[0]->shear_modulus() / 2;
  if (c1 <= c1_fat) return;
  const auto skin =
      std::make_shared<SkinMembrane>(c1 - c1_fat, problem.skin.thickness, problem.skin.stiffening);
  for (const auto& [e, face] : faces_labelled(problem.mesh, FaceLabel::skin))
    model.add_surface_potential(e, face, skin);
}

std::shared_ptr<SpringBed> spring_bed(double k, std::optional<double> reach) {
  return std::make_shared<SpringBed>(k, reach.value_or(std::numeric_limits<double>::infinity()));
}

void hold_chest_wall(const BreastProblem& problem, const HermiteMesh& prone, BreastModel& breast) {
  const auto& options = problem.boundary;
  if (options.chest_wall == ChestWall::clamped)
    return hold_clamped(problem.mesh.mesh, breast.wall_faces, *breast.dofs);
  const bool smooth = options.wall_smoothing > 0;
  breast.wall = std::make_shared<WallSurface>(
      smooth ? with_smooth_wall(prone, problem.mesh.ties, breast.wall_faces, options.wall_smoothing)
             : prone,
      breast.wall_faces);
  const bool is_wall = problem.prone.empty() && !smooth;
  const auto hold =
      std::make_shared<WallHold>(breast.wall, kWallPenalty * breast.penalty_unit(),
                                 is_wall ? WallRest::on_wall : WallRest::as_reference);
  const auto springs = spring_bed(options.chest_wall_spring, options.chest_wall_reach);
  for (const auto& [e, face] : breast.wall_faces) {
    breast.model->add_surface_potential(e, face, hold);
    for (const Face& f : breast.model->faces(e))
      for (int q = 0; f.face() == face && q < f.num_points(); ++q) hold->remember_rest(f.point(q));
    if (options.chest_wall == ChestWall::sliding && options.chest_wall_spring > 0)
      breast.model->add_surface_potential(e, face, springs);
  }
}

void hold_skin(const BreastProblem& problem, const HermiteMesh& prone, BreastModel& breast) {
  if (!problem.pressed) return;
  breast.skin_hold = std::make_shared<SkinHold>();
  const double k = kSkinHoldPenalty * breast.penalty_unit();
  for (const auto& [e, face] : faces_labelled(problem.mesh, FaceLabel::skin)) {
    breast.model->add_surface_potential(e, face, breast.skin_hold);
    for (const Face& f : breast.model->faces(e)) {
      if (f.face() != face) continue;
      const Face imaged(e, face, element_coefficients(prone, prone.nodes(), e), f.points1d());
      for (int q = 0; q < f.num_points(); ++q) {
        const SurfacePoint& there = imaged.point(q);
        breast.skin_hold->remember(f.point(q), there.X,
                                   k * problem.pressed.at(there.X, there.normal).share);
      }
    }
  }
}

void hold_cut_faces(const BreastProblem& problem, BreastModel& breast) {
  const auto& options = problem.boundary;
  const Faces faces = faces_labelled(problem.mesh, FaceLabel::cut);
  if (options.cut_faces == CutFaces::clamped)
    return hold_clamped(problem.mesh.mesh, faces, *breast.dofs);
  if (options.cut_faces == CutFaces::free) return;
  for (const auto& [e, face] : faces) {
    const double k = mean_modulus(breast.model->element(e)) / options.cut_face_depth;
    breast.model->add_surface_potential(e, face, spring_bed(k, options.cut_face_reach));
  }
}

void tie_nodes(const MeshFile& mesh, DofMap& dofs) {
  for (const ParameterTie& tie : mesh.ties)
    for (int i = 0; i < 3; ++i)
      dofs.tie(dof_index(tie.node, tie.parameter, i), dof_index(tie.to_node, tie.to_parameter, i),
               tie.factor);
}

}  // namespace

Faces faces_labelled(const MeshFile& mesh, FaceLabel label) {
  Faces faces;
  for (int e = 0; e < mesh.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      if (mesh.faces[e][face] == label) faces.push_back({e, face});
  return faces;
}

void BreastModel::set_skin_share(double share) {
  model->set_dead_share(share);
  if (skin_hold) skin_hold->set_share(share);
}

BreastModel make_breast_model(const BreastProblem& problem, const SolidOptions& solid) {
  check_problem(problem);
  BreastModel breast;
  const HermiteMesh& mesh = problem.mesh.mesh;
  breast.wall_faces = faces_labelled(problem.mesh, FaceLabel::chest_wall);
  check(!breast.wall_faces.empty(),
        "nothing holds the breast: no face of the mesh is labelled chest_wall");
  const HermiteMesh prone = prone_mesh(problem);
  const ProneTissue tissue = prone_tissue(problem, prone);
  breast.model = std::make_unique<Model>(mesh, in_turn(tissue.materials), solid);
  if (!problem.gravity.isZero())
    breast.model->set_body_force([weight = (problem.density * problem.gravity).eval()](
                                     const Eigen::Vector3d&) { return weight; });
  breast.model->set_dead_forces(problem.skin_forces);
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int q = 0; q < kPoints; ++q)
      breast.largest_modulus =
          std::max(breast.largest_modulus, breast.model->element(e).material(q).shear_modulus());
  breast.element_size = std::cbrt(tissue.volume / mesh.num_elements());
  breast.dofs = std::make_unique<DofMap>(mesh);
  tie_nodes(problem.mesh, *breast.dofs);
  add_skin(problem, *breast.model);
  hold_chest_wall(problem, prone, breast);
  hold_cut_faces(problem, breast);
  hold_skin(problem, prone, breast);
  breast.dofs->number(mesh);
  return breast;
}

}  // namespace mammotwin
