#pragma once

#include <optional>
#include <string>

#include "fitting/mesh/mesh_file.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// A lesion as somebody with an ultrasound probe looks for it, the patient on her back.
struct SupinePlace {
  Eigen::Vector3d skin_in_lps = Eigen::Vector3d::Zero();  ///< the skin straight above it [mm]
  double depth_mm = 0;                                    ///< below that
  std::string clock;          ///< of the skin's point about the nipple; empty within 10 mm
  double from_nipple_mm = 0;  ///< of the skin's point, straight
};

/// `supine`: the same mesh as `prone`, lying. Nothing where the line straight forward from the
/// lesion does not leave the mesh through skin.
std::optional<SupinePlace> supine_place(const MeshFile& prone, const HermiteMesh& supine, Side side,
                                        const Eigen::Vector3d& lesion_in_prone,
                                        const Eigen::Vector3d& nipple_in_prone);

}  // namespace mammotwin
