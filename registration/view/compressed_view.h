#pragma once

#include <map>
#include <string>
#include <vector>

#include "registration/view/plate_escape.h"
#include "registration/view/view_frame.h"

namespace mammotwin {

/// Which view a compressed mesh shows, and where its plates stand.
struct CompressedView {
  std::string name;  ///< "cc", "mlo", or another
  Side side = Side::left;
  double angle_deg = 0;
  double thickness_mm = 0;  ///< measured extent of the compressed breast along the beam
  ViewFrame frame;
  double turn_deg = 0;  ///< of the detector about the beam, from lateral towards depth
  PlateEscape escape{};
};

/// Axes of the view: those of its angle, turned.
Eigen::Matrix3d axes_of(Side side, double angle_deg, double turn_deg);

/// Enters the view into a mesh file's metadata.
void write_view(const CompressedView& view, std::map<std::string, std::vector<double>>& metadata);

/// What `compress` wrote beside the mesh: view_side (0 left, 1 right), view_angle_deg,
/// thickness_mm, view_origin_lps_mm (3), view_axes (9: depth, lateral, height),
/// view_swing_mm, view_roll_deg, view_slid_mm and, where the detector is turned, view_turn_deg.
/// Throws std::runtime_error naming `file` and the entry that is missing or contradicts the angle.
CompressedView compressed_view(const std::string& name, const std::string& file,
                               const std::map<std::string, std::vector<double>>& metadata);

}  // namespace mammotwin
