#pragma once

#include <Eigen/Core>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// The frame of one mammographic view, anchored at the middle of the detector's chest-wall edge on
/// the support surface. View coordinates [mm] are (depth, lateral, height):
///   depth    from the chest-wall edge towards the nipple side, antero-posterior;
///   lateral  along the edge: towards the patient's lateral side (CC), superior-lateral (MLO);
///   height   from the support surface towards the X-ray source, against the beam.
/// The axes are orthonormal. They are right-handed for a left breast and left-handed for a right
/// one, so that "lateral" means lateral on both sides.
struct ViewFrame {
  Eigen::Vector3d origin_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();       ///< rows: depth, lateral, height in LPS

  Eigen::Vector3d view_from_lps(const Eigen::Vector3d& x_in_lps) const {
    return axes * (x_in_lps - origin_in_lps);
  }
  Eigen::Vector3d lps_from_view(const Eigen::Vector3d& x_in_view) const {
    return origin_in_lps + axes.transpose() * x_in_view;
  }
};

/// Axes for positioner angle t, s = +1 for a left breast and -1 for a right one. The beam runs from
/// superior-medial to inferior-lateral; t = 0 is CC:
///   depth = (0, -1, 0),  lateral = (s cos t, 0, sin t),  height = -beam = (-s sin t, 0, cos t).
Eigen::Matrix3d view_axes(Side side, double angle_deg);

/// 15 degrees off CC and more: across the detector lies up and down rather than lateral and medial.
/// Positioners stand at 0 for CC and at 30 to 60 for MLO.
bool is_oblique(double angle_deg);

}  // namespace mammotwin
