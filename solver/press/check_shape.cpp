#include "solver/press/check_shape.h"

#include <stdexcept>
#include <string>

#include "fitting/mesh/jacobian_bound.h"

namespace mammotwin {
namespace {

void check_finite(const HermiteMesh& mesh) {
  for (int node = 0; node < mesh.num_nodes(); ++node)
    if (!mesh.node(node).allFinite())
      throw std::invalid_argument("node " + std::to_string(node) +
                                  " of the mesh has a parameter that is not a finite number");
}

}  // namespace

void check_shape(const CompressionProblem& problem) {
  check_finite(problem.mesh.mesh);
  const HermiteMesh imaged = problem.prone.empty()
                                 ? problem.mesh.mesh
                                 : HermiteMesh(problem.prone, problem.mesh.mesh.elements());
  check_finite(imaged);
  if (!proved_valid(imaged))
    throw std::invalid_argument("the mesh is folded: det dX/dxi is not positive everywhere");
}

}  // namespace mammotwin
