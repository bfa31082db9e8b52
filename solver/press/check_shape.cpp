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

void check_shape(const HermiteMesh& solved, const HermiteMesh& imaged) {
  check_finite(solved);
  check_finite(imaged);
  if (!proved_valid(imaged))
    throw std::invalid_argument("the mesh is folded: det dX/dxi is not positive everywhere");
}

void check_shape(const CompressionProblem& problem) {
  const HermiteMesh& solved = problem.mesh.mesh;
  check_shape(solved,
              problem.prone.empty() ? solved : HermiteMesh(problem.prone, solved.elements()));
}

}  // namespace mammotwin
