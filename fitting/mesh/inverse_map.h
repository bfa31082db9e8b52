#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "fitting/mesh/bezier_evaluation.h"

namespace mammotwin {

/// From a position [mm] to the material point that stands there. Elements are cut into parts
/// whose control points bound them; a tree over those boxes proposes starts for Newton.
/// Queries are const and may run in parallel.
class InverseMap {
 public:
  /// Throws std::invalid_argument if the mesh has no element.
  explicit InverseMap(const HermiteMesh& mesh);

  /// The point at x, to 1e-9 mm; empty if x is outside every element. Where folded elements
  /// hold x twice, one of the two.
  std::optional<MeshPoint> locate(const Eigen::Vector3d& x) const;

  /// As locate, trying Newton from `guess` first: fast for a walk through neighbouring points.
  std::optional<MeshPoint> locate(const Eigen::Vector3d& x, const MeshPoint& guess) const;

  /// The mesh's point nearest to x: locate(x) inside, else a point of the outer surface.
  /// A local minimum of distance in the box it is found in; boxes are searched nearest first.
  MeshPoint nearest(const Eigen::Vector3d& x) const;

 private:
  struct Part {
    int element;
    Eigen::Vector3d centre;  ///< of the part, in ξ
    Eigen::AlignedBox3d box;
  };
  struct Branch {
    Eigen::AlignedBox3d box;
    int first, last;            ///< parts [first, last)
    int left = -1, right = -1;  ///< branches; −1 in a leaf
  };

  int build(int first, int last);
  std::optional<MeshPoint> newton(const Eigen::Vector3d& x, MeshPoint start) const;
  double descend(const Eigen::Vector3d& x, MeshPoint& p) const;

  std::vector<PaddedBezierElement> elements_;
  std::vector<Part> parts_;
  std::vector<Branch> branches_;
};

}  // namespace mammotwin
