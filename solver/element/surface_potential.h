#pragma once

#include <Eigen/Core>
#include <stdexcept>

namespace mammotwin {

/// What a potential may know of a face's quadrature point besides where it is now.
struct SurfacePoint {
  Eigen::Vector3d X;       ///< reference position [mm]
  Eigen::Vector3d A1, A2;  ///< reference tangents ∂X/∂ξ of the face's two directions [mm]
  Eigen::Vector3d normal;  ///< outward unit normal of the reference shape
  double area;             ///< reference area of the point [mm²]
  int index = 0;           ///< of the point among all of its model's
};

/// Energy per reference area as a function of y = (x, a₁, a₂): position and face tangents.
struct SurfaceResponse {
  double energy = 0;                     ///< [kPa mm]
  Eigen::Matrix<double, 9, 1> gradient;  ///< ∂energy/∂y; only the slots in use are read
  Eigen::Matrix<double, 9, 9> hessian;
};

/// A term of the total potential on element faces: contact, springs, membrane, traction.
class SurfacePotential {
 public:
  /// y has three slots of three: 0 is x, 1 and 2 are a₁ and a₂. A potential uses [first, end).
  struct Slots {
    int first, end;
  };
  static constexpr Slots kPosition{0, 1}, kTangents{1, 3}, kAll{0, 3};

  virtual ~SurfacePotential() = default;
  virtual Slots slots() const = 0;

  /// False where the point contributes nothing (out of contact). `order` 0, 1 or 2: how many
  /// derivatives are wanted.
  virtual bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
                       SurfaceResponse& response) const = 0;

  /// ∂(∂energy/∂x)/∂x that comes of what the energy holds fixed and the state moves (friction's
  /// pressures): not symmetric, so not of the hessian. False where there is none.
  virtual bool circulation(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point,
                           Eigen::Matrix3d& derivative) const;

  /// ∂gradient/∂(X, A₁, A₂) with y and `area` fixed; column slots as those of y. Only unloading
  /// asks (element/reference_tangent.cpp); throws std::logic_error where a potential cannot say.
  virtual Eigen::Matrix<double, 9, 9> reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                           const SurfacePoint& point) const;
};

inline bool SurfacePotential::circulation(const Eigen::Matrix<double, 9, 1>&, const SurfacePoint&,
                                          Eigen::Matrix3d&) const {
  return false;
}

inline Eigen::Matrix<double, 9, 9> SurfacePotential::reference_derivative(
    const Eigen::Matrix<double, 9, 1>&, const SurfacePoint&) const {
  throw std::logic_error("a load on the breast's surface cannot take part in unloading");
}

}  // namespace mammotwin
