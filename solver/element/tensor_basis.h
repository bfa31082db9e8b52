#pragma once

#include <array>

namespace mammotwin {

/// How an element's arrays are laid out, everywhere in solver/element.
///
/// Functions are products of one-dimensional cubic Hermite functions
/// (fitting/mesh/hermite_basis.h):
///   function a = t₁ + 4 t₂ + 16 t₃,   tᵢ = 2 (end of ξᵢ) + (derivative along ξᵢ),
/// points of the 4 x 4 x 4 Gauss rule are q = q₁ + 4 q₂ + 16 q₃, and a displacement unknown is
/// component i of function a at index 64 i + a.
inline constexpr int kPoints1d = 4;
inline constexpr int kFunctions = 64;
inline constexpr int kPoints = 64;
inline constexpr int kUnknowns = 3 * kFunctions;

/// One-dimensional functions at the Gauss points: value[q][t], slope[q][t].
struct HermiteTable {
  std::array<double, kPoints1d> points, weights;
  double value[kPoints1d][4];
  double slope[kPoints1d][4];
};
const HermiteTable& hermite_table();

/// Where function a lives in a node array: corner and nodal parameter of HermiteMesh.
constexpr int corner_of_function(int a) {
  return (a >> 1 & 1) | (a >> 3 & 1) << 1 | (a >> 5 & 1) << 2;
}
constexpr int parameter_of_function(int a) {
  return (a & 1) | (a >> 2 & 1) << 1 | (a >> 4 & 1) << 2;
}

}  // namespace mammotwin
