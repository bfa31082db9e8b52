#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {

/// A block held at its top, and a plate that presses from below and is then drawn along x. With
/// `endless`, x = 0 and x = L move alike (a cut out of an endless strip).
class PlateUnderBlock {
 public:
  static constexpr double kC1 = 3;  ///< [kPa]
  static constexpr double kCoefficient = 0.4;
  static constexpr double kSlip = 0.02;  ///< [mm]

  PlateUnderBlock(const HermiteMesh& mesh, bool endless)
      : mesh_(mesh),
        model_(mesh, uniform(std::make_shared<NeoHookean>(kC1)),
               {PressureSpace::trilinear, 1e6, 0}),
        dofs_(mesh) {
    faces_ = faces_at(mesh, 2, 0);
    contact_->penalty = 1000;
    contact_->plates = {Plate{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0, true}};
    for (const auto& [e, face] : faces_) {
      model_.add_surface_potential(e, face, contact_, contact_->points1d);
      model_.add_surface_potential(e, face, friction_, contact_->points1d);
    }
    const double height = mesh.nodes().back()(2, 0);
    for (int axis : {0, 2}) hold_plane_along(axis, height);
    hold_plane(mesh, 1, 0, dofs_);
    if (endless) tie_ends();
    dofs_.number(mesh);
    newton_ = std::make_unique<Newton>(model_, dofs_);
    friction_->commit(model_, state_, faces_);
  }

  /// Presses by `depth` without friction; from there on the block sticks.
  void press(double depth) {
    contact_->follow = {};
    contact_->plates[0].point.z() = depth;
    settle();
    friction_->restore({});
    friction_->commit(model_, state_, faces_);
    contact_->follow = following(*friction_, model_, faces_);
  }

  /// Draws the plate along x, in equal steps.
  void draw(double distance, int steps) {
    for (int step = 0; step < steps; ++step) {
      contact_->plates[0].point.x() += distance / steps;
      settle();
      friction_->commit(model_, state_, faces_);
    }
  }

  Eigen::Vector3d force() const {  ///< of the plate [mN]
    return contact_figures(model_, state_, *contact_, 0, faces_, friction_.get()).force;
  }
  Eigen::Vector3d top_force() const {  ///< of what holds the top, from the residual
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const auto residual = newton_->assembler().nodal_residual(state_);
    for (int i = 0; i < mesh_.num_nodes(); ++i)
      if (mesh_.node(i)(2, 0) > mesh_.nodes().back()(2, 0) - 1e-9) sum += residual[i].col(0);
    return sum;
  }
  const State& state() const { return state_; }
  const HermiteMesh& mesh() const { return mesh_; }
  const PlateFriction& friction() const { return *friction_; }
  double plate_x() const { return contact_->plates[0].point.x(); }

 private:
  void settle() {
    NewtonOptions options;
    options.tolerance = 1e-9;
    const NewtonReport report = resettle(*newton_, *contact_, options, state_);
    ASSERT_TRUE(report.usable()) << report.reason;
  }
  void hold_plane_along(int component, double height) {
    for (const auto& [e, face] : faces_at(mesh_, 2, height))
      for (int dof : face_dofs(mesh_, e, face, component)) dofs_.prescribe(dof);
  }
  void tie_ends() {
    for (int i = 0; i < mesh_.num_nodes(); ++i)
      for (int j = 0; j < mesh_.num_nodes(); ++j) {
        const Eigen::Vector3d apart = mesh_.node(j).col(0) - mesh_.node(i).col(0);
        if (mesh_.node(i)(0, 0) > 1e-9 || apart.x() < 1e-9 || apart.tail<2>().norm() > 1e-9 ||
            mesh_.node(j)(0, 0) < mesh_.nodes().back()(0, 0) - 1e-9)
          continue;
        for (int k = 0; k < 24; ++k) dofs_.tie(24 * j + k, 24 * i + k, 1);
      }
  }

  HermiteMesh mesh_;
  Model model_;
  DofMap dofs_;
  std::shared_ptr<PlateContact> contact_ = std::make_shared<PlateContact>();
  std::shared_ptr<PlateFriction> friction_ =
      std::make_shared<PlateFriction>(contact_, kCoefficient, kSlip);
  std::vector<std::pair<int, int>> faces_;
  State state_ = model_.rest();
  std::unique_ptr<Newton> newton_;
};

}  // namespace mammotwin
