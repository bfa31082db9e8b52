#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fitting/mesh/hermite_mesh.h"
#include "solver/contact/plate.h"
#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Which nodal parameter of the mesh weighs function a of 16 of an element's face: (node,
/// parameter).
std::pair<int, int> face_parameter(const HermiteMesh& mesh, int element, int face, int a);

/// All 16 of a face, as columns.
Eigen::Matrix<double, 3, 16> face_coefficients(const HermiteMesh& mesh, int element, int face);

/// The undeformed chest wall: bicubic Hermite patches, continued straight on beyond their rim by
/// patches that join without a kink, and the signed distance to them. Were each only continued by
/// itself, the distance would leap where a point beyond the rim changes from one to the next.
class WallSurface {
 public:
  /// faces: (element, face) of the mesh. Throws std::invalid_argument if there are none.
  WallSurface(const HermiteMesh& mesh, const std::vector<std::pair<int, int>>& faces);

  /// gap > 0 on the tissue's side; exact derivatives of the distance to the nearest patch.
  Gap gap(const Eigen::Vector3d& x) const;

 private:
  static constexpr int kSamples1d = 9;  // a side of a patch
  struct Patch {
    Eigen::Matrix<double, 3, 16> coefficients;
    double orientation;  ///< +1 where s₁ x s₂ points into the tissue
    Eigen::Matrix<double, 3, kSamples1d * kSamples1d> samples;
  };
  struct Foot {
    const Patch* patch;
    Eigen::Vector2d xi;
    double distance;  ///< to the foot clamped to the patch [mm]
    bool inside;
  };
  void add_patch(const Eigen::Matrix<double, 3, 16>& coefficients, double orientation);
  void find_boxes();
  Foot project_from(const Patch& patch, Eigen::Vector2d xi, const Eigen::Vector3d& x) const;
  Foot project(const Patch& patch, const Eigen::Vector3d& x) const;
  Foot nearest_foot(const Eigen::Vector3d& x) const;

  std::vector<Patch> patches_;
  Eigen::ArrayX3d low_, high_;  ///< corners of a box round each patch
};

/// Where a point stands off the wall when nothing pulls at it.
enum class WallRest {
  on_wall,       ///< on it: the reference shape is the one that gave the wall
  as_reference,  ///< as far as in the reference shape, where another shape gave the wall
};

/// Holds points on a wall: energy = ε/2 (gap − gap at rest)², both ways (the breast neither lifts
/// off the pectoral fascia nor enters it), free to slide along it.
class WallHold : public SurfacePotential {
 public:
  /// penalty ε [kPa/mm] > 0.
  WallHold(std::shared_ptr<const WallSurface> surface, double penalty,
           WallRest rest = WallRest::on_wall)
      : surface_(std::move(surface)), penalty_(penalty), rest_(rest) {}

  /// Seeks the point's gap at rest now, and not at every state.
  void remember_rest(const SurfacePoint& point);

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
  Eigen::Matrix<double, 9, 9> reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                   const SurfacePoint& point) const override;

 private:
  double gap_at_rest(const SurfacePoint& point) const;

  std::shared_ptr<const WallSurface> surface_;
  double penalty_;
  WallRest rest_;
  std::vector<std::optional<double>> remembered_;  ///< by surface point
};

}  // namespace mammotwin
