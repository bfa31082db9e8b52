#pragma once

#include <vector>

#include "fitting/mesh/hermite_mesh.h"
#include "solver/element/solid_element.h"

namespace mammotwin {

/// What element e has of nodal parameters `x` of `mesh`, a row for each of its functions.
inline SolidElement::Coefficients element_coefficients(const HermiteMesh& mesh,
                                                       const std::vector<HermiteMesh::Node>& x,
                                                       int e) {
  SolidElement::Coefficients c;
  const auto& corners = mesh.corners(e);
  for (int a = 0; a < kFunctions; ++a)
    c.row(a) = x[corners[corner_of_function(a)]].col(parameter_of_function(a)).transpose();
  return c;
}

}  // namespace mammotwin
