#pragma once

#include <optional>
#include <string>

#include "fitting/mesh/mesh_file.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// How far a lesion may lie from where the model has it supine, seen from the nipple: root mean
/// square of its way against the nipple, lateral, posterior and along the body, over its distance
/// from it. Of 84 landmarks of 32 women imaged in both poses, taken not to move against the nipple
/// at all, as today's tissue nearly has it (docs/measured/supine_spread.md).
inline const Eigen::Vector3d kSupineSpread{0.223, 0.200, 0.130};
/// Semi-axes of an ellipsoid that holds 90 %, over that: with the spread of half of the women it
/// holds 91 % of the others' landmarks.
inline constexpr double kSupineSpreads = 3;

/// Semi-axes along LPS [mm] of the ellipsoid round a lesion that holds it with 90 %, supine and
/// seen from the nipple.
Eigen::Vector3d supine_semi_axes_mm(const Eigen::Vector3d& lesion_in_prone,
                                    const Eigen::Vector3d& nipple_in_prone);

/// A lesion as somebody with an ultrasound probe looks for it, the patient on her back.
struct SupinePlace {
  Eigen::Vector3d skin_in_lps = Eigen::Vector3d::Zero();  ///< the skin straight above it [mm]
  double depth_mm = 0;                                    ///< below that
  std::string clock;          ///< of the skin's point about the nipple; empty within 10 mm
  double from_nipple_mm = 0;  ///< of the skin's point, straight
  Eigen::Vector3d lesion_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  Eigen::Vector3d semi_axes_mm = Eigen::Vector3d::Zero();   ///< supine_semi_axes_mm()
};

/// `supine`: the same mesh as `prone`, lying. Nothing where the line straight forward from the
/// lesion does not leave the mesh through skin.
std::optional<SupinePlace> supine_place(const MeshFile& prone, const HermiteMesh& supine, Side side,
                                        const Eigen::Vector3d& lesion_in_prone,
                                        const Eigen::Vector3d& nipple_in_prone);

}  // namespace mammotwin
