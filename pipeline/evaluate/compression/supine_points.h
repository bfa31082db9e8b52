#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "segmentation/segmentation.h"
#include "solver/load/wall_surface.h"

namespace mammotwin {

/// What a breast does from prone to supine, as it is counted in women imaged in both poses.
struct SupineMoves {
  Eigen::Vector3d nipple = Eigen::Vector3d::Zero();  ///< lateral, posterior, superior [mm]
  double landmark_mm = 0;                            ///< median over points in the tissue
  double ribs_prone_mm = 0, ribs_supine_mm = 0;      ///< the points' medians
};

/// Of the women's landmarks those are compared with a model that lie so far from the ribs prone:
/// a mesh reaches neither the ribs nor the axilla.
inline constexpr double kNearestToRibs_mm = 10, kFarthestFromRibs_mm = 60;

/// The points of one breast that are followed: its nipple, and 540 of the prone tissue, the same
/// for each breast of that shape, where the women's landmarks lie: 54 of 84 are seen 10 to 60 mm
/// from the ribs (6 mm behind the chest wall of the mesh, which is the front of the muscle), half
/// of them within 19 mm, and as many of the points lie in each band of that distance, if the breast
/// has such tissue. All lie in the upper outer part, 22 to 182 mm above the nipple, half of them
/// more than 85 mm (label maps' regions end 78 to 119 mm above it); 95 % lie no more than 10 mm
/// medial of it and half more than 30 mm lateral. (Above: the data's axis that is called superior
/// must point down, as nipples would go 18 mm down along it as women lie back, and all landmarks
/// lie below the breast.)
class SupinePoints {
 public:
  /// `prone`: a mesh as imaged. Throws std::runtime_error where no tissue lies so.
  SupinePoints(const MeshFile& prone, Side side, const Eigen::Vector3d& nipple_in_lps);

  /// `supine`: the nodes of the same mesh, lying.
  SupineMoves moves(const std::vector<HermiteMesh::Node>& supine) const;

 private:
  struct Landmark {
    MeshPoint point;
    Eigen::Vector3d prone;
    double ribs_prone = 0;
  };
  Side side_;
  HermiteMesh prone_;
  WallSurface wall_;
  MeshPoint nipple_;
  Eigen::Vector3d nipple_in_lps_;
  std::vector<Landmark> landmarks_;
};

}  // namespace mammotwin
