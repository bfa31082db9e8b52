#pragma once

#include <Eigen/Geometry>

#include "fitting/fit_breast.h"
#include "fitting/scan/scan_cloud.h"

namespace mammotwin {

/// How a scan is read.
struct ScannedSkinOptions {
  double unit_mm = 1;  ///< length of the file's unit, 1e-6 to 1e6 [mm]
  /// A point of the base plane and its normal, away from the breast's tip or towards it, in the
  /// file's axes and unit. Default: the plane of the scan's rim, `base_depth_mm` behind it.
  std::optional<Eigen::Vector3d> base_point, base_normal;
  double base_depth_mm = 10;                      ///< 2 to 100 [mm]
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< towards the head, in the file's axes
  Side side = Side::left;
};

/// A scanned breast in the frame of all other stages: base plane y = 0, the breast in front of it
/// (y < 0), z up, x = z = 0 at the middle of the scan's rim. Tissue is all fat; behind the base
/// plane is muscle. Voxels of 1 mm.
struct ScannedBreast {
  Segmentation segmentation;
  ScannedSkin skin;
  Eigen::Isometry3d frame_from_file = Eigen::Isometry3d::Identity();  ///< after scaling to mm
  int points = 0, outliers = 0, holes = 0;                            ///< read, taken out, filled
};

/// Throws std::runtime_error naming the file and the likely cause (read_scan_points,
/// scan_surface), or where no breast stands out from the base.
ScannedBreast read_scanned_breast(const std::filesystem::path& path,
                                  const ScannedSkinOptions& options);

}  // namespace mammotwin
