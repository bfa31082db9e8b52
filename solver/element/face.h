#pragma once

#include <array>
#include <vector>

#include "solver/element/solid_element.h"
#include "solver/element/surface_potential.h"

namespace mammotwin {

/// One face of an element with an n x n Gauss rule: 16 functions carry its shape.
///
/// Faces are numbered ξ₁ = 0, ξ₁ = 1, ξ₂ = 0, ξ₂ = 1, ξ₃ = 0, ξ₃ = 1.
class Face {
 public:
  static constexpr int kFunctions = 16;

  /// X: the reference shape of the element; points1d = n, 4 to 10; first_index: of its points.
  Face(int element, int face, const SolidElement::Coefficients& X, int points1d,
       int first_index = 0);

  int element() const { return element_; }
  int face() const { return face_; }
  int points1d() const { return points1d_; }
  int num_points() const { return static_cast<int>(points_.size()); }
  const SurfacePoint& point(int q) const { return points_[q]; }
  double area() const;  ///< reference [mm²]

  /// (x, a₁, a₂) at point q of the deformed shape x.
  Eigen::Matrix<double, 9, 1> deformed(const SolidElement::Coefficients& x, int q) const;

  /// Adds the potential's energy, residual and (if asked) tangent to the element's.
  void add(const SurfacePotential& potential, const SolidElement::Coefficients& x, TangentKind kind,
           ElementSystem& system) const;

  /// Adds the potential's circulation; rows and columns are 16 i + a of component i and face
  /// function a. False where it has none.
  using Circulation = Eigen::Matrix<double, 3 * kFunctions, 3 * kFunctions>;
  bool add_circulation(const SurfacePotential& potential, const SolidElement::Coefficients& x,
                       Circulation& circulation) const;

  /// Adds ∂residual/∂X of the potential, X the face's reference shape.
  void add_reference(const SurfacePotential& potential, const SolidElement::Coefficients& x,
                     ReferenceSystem& system) const;

  /// The element's function behind face function a.
  int function(int a) const { return functions_[a]; }

 private:
  struct Table;  ///< values and derivatives of the functions at the points of a rule
  static const Table& table(int points1d);

  int element_, face_, points1d_;
  std::array<int, kFunctions> functions_;
  std::vector<SurfacePoint> points_;
};

/// The two element directions of a face in ascending order.
constexpr std::array<int, 2> face_directions(int face) {
  return face < 2   ? std::array<int, 2>{1, 2}
         : face < 4 ? std::array<int, 2>{0, 2}
                    : std::array<int, 2>{0, 1};
}

/// Element coordinates of a point of a face, from its coordinates along the face's directions.
inline Eigen::Vector3d point_on_face(int face, double s, double t) {
  const auto [d1, d2] = face_directions(face);
  Eigen::Vector3d xi;
  xi[face / 2] = face % 2;
  xi[d1] = s;
  xi[d2] = t;
  return xi;
}

}  // namespace mammotwin
