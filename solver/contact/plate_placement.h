#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "solver/contact/plate_mesh.h"

namespace mammotwin {

/// Where the plates should stand. The three directions are orthonormal.
///
/// A tilted paddle turns about the line where the flat part of its face begins at the chest wall;
/// positive lowers its front. `thickness` is then the extent where the breast is thickest between
/// the flat parts, as it is with facets.
struct PlateOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();      ///< from the support to the paddle
  Eigen::Vector3d depth = -Eigen::Vector3d::UnitY();  ///< from the chest wall to the nipple
  double thickness = 0;        ///< asked, of the deformed skin between the plates [mm]
  double lift = 0;             ///< of the middle plane above the volume centroid [mm]
  double rounding = 10;        ///< radius of the rear edges [mm] > 0
  double wall_clearance = 10;  ///< from the chest wall to the edges [mm] >= 0
  double width = kEndless;     ///< of the plates, rounded edges included [mm] > 2 rounding
  double length = kEndless;    ///< from the rear to the front edge, the same [mm] > 2 rounding
  double paddle_tilt = 0;      ///< without load [deg], -30 to 30
  /// What a flexible paddle's holder gives way by: tilt = paddle_tilt + moment / tilt_spring, the
  /// moment about an axis `pivot` in front of the rear edge.
  double tilt_spring = kEndless;  ///< [mN mm/deg] > 0; endless: a rigid paddle
  double pivot = 200;             ///< [mm]
  std::shared_ptr<const PlateMesh> support_mesh, paddle_mesh;  ///< instead of flat plates

  static constexpr double kEndless = std::numeric_limits<double>::infinity();
  bool endless_sideways() const { return width == kEndless && !support_mesh && !paddle_mesh; }
};

/// The pair of plates in place.
struct PlacedPlates {
  Plate support, paddle;
  double paddle_tilt = 0;     ///< [deg]
  double edge = 0;            ///< depth coordinate of both rear edges: depth · x [mm]
  double support_height = 0;  ///< up · x of the support's face [mm]
  double paddle_height = 0;   ///< up · x of the paddle's face [mm]
  double lateral_middle = 0;  ///< (depth x up) · x of the breast's middle [mm]
};

/// Measures a breast along the plates' directions, on a grid of points of its outer faces.
class PlateFrame {
 public:
  /// Throws std::invalid_argument if the directions are not orthonormal or a length is out of
  /// range, or if the mesh has no chest wall or no skin in front of the plates' edge.
  PlateFrame(const MeshFile& mesh, const PlateOptions& options);

  double edge() const { return edge_; }
  double centroid_height() const { return centroid_height_; }

  /// Smallest and largest height of the outer faces of x between the flat parts of the plates.
  std::pair<double, double> heights(const std::vector<HermiteMesh::Node>& x) const;

  /// Extent along `up` of x between the flat plates [mm].
  double extent(const std::vector<HermiteMesh::Node>& x) const;

  /// Of the mesh's own shape, in front of the plates' edge [mm³].
  double volume_in_front() const;

  /// That of the mesh's own shape [mm].
  double free_extent() const { return extent(reference_); }

  /// Heights at which the plates just touch the mesh's own shape, edges and all.
  std::pair<double, double> touching_heights() const { return touching_; }

  /// tilt: of the paddle [deg].
  PlacedPlates place(double support_height, double paddle_height, double tilt) const;

 private:
  struct Sample {
    int element;
    HermiteMesh::Weights weights;
  };
  std::vector<Eigen::Vector3d> outer_points(const std::vector<HermiteMesh::Node>& x) const;

  void find_flat_part();
  bool over_flat_part(const Eigen::Vector3d& x) const;
  Eigen::Vector3d border_between(Eigen::Vector3d a, Eigen::Vector3d b) const;
  double touching_height(bool paddle, double low, double high) const;

  PlateOptions options_;
  std::vector<HermiteMesh::Corners> elements_;
  std::vector<HermiteMesh::Node> reference_;
  std::vector<Sample> outer_;  ///< face after face, each a square grid
  double edge_, centroid_height_, lateral_middle_;
  std::pair<double, double> touching_;
  struct {
    double rear, front, left, right;
  } flat_;  ///< of both plates, along depth and depth x up [mm]
};

/// Volume of what lies beyond `edge` [mm] along `depth` [mm³].
double volume_in_front(const HermiteMesh& mesh, const Eigen::Vector3d& depth, double edge);

/// Extent along `up` of the uncompressed breast where plates so placed would press it [mm].
double free_thickness(const MeshFile& mesh, const PlateOptions& options);

}  // namespace mammotwin
