#pragma once

#include <memory>

#include "pipeline/validation/gel_cylinder/gel_cylinder_mesh.h"
#include "solver/material/neo_hookean.h"
#include "solver/newton/assembler.h"
#include "solver/newton/cholesky.h"

namespace mammotwin {

/// An eighth of a gel cylinder, clamped at one end, evenly meshed with n elements along half the
/// square's side: what the linear algebra is timed on.
struct CylinderProblem {
  explicit CylinderProblem(int n)
      : file(cylinder_part(29, 40, {2 * n, (n + 1) / 2, n + 1}, CylinderPart::eighth)),
        model(
            file.mesh,
            [gel = std::make_shared<NeoHookean>(3.0)](const Eigen::Vector3d&, double) {
              return gel;
            },
            SolidOptions{}),
        dofs(file.mesh),
        state(model.rest()) {
    for (const auto& [e, face] : faces_in_plane(file.mesh, 2, 0))
      for (int i = 0; i < 3; ++i)
        for (int dof : face_dofs(file.mesh, e, face, i)) dofs.prescribe(dof);
    for (const ParameterTie& tie : file.ties)
      for (int i = 0; i < 3; ++i)
        dofs.tie(dof_index(tie.node, tie.parameter, i), dof_index(tie.to_node, tie.to_parameter, i),
                 tie.factor);
    dofs.number(file.mesh);
    assembler = std::make_unique<Assembler>(model, dofs);
  }

  MeshFile file;
  Model model;
  DofMap dofs;
  State state;
  std::unique_ptr<Assembler> assembler;
};

/// Of one core on 1024 x 1024 matrices, with the BLAS that the solver uses [GF/s]; measured once.
double dgemm_rate();

}  // namespace mammotwin
