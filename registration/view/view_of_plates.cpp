#include "registration/view/view_of_plates.h"

#include <Eigen/Geometry>

namespace mammotwin {

Eigen::Vector3d origin_of_plates(const PlateOptions& options, const PlacedPlates& placed) {
  return options.depth * placed.edge + options.up * placed.support_height +
         options.depth.cross(options.up) * placed.lateral_middle;
}

CompressedView view_of_plates(const std::string& name, Side side, double angle_deg, double turn_deg,
                              const PlateOptions& options, const CompressionResult& result) {
  CompressedView view{name, side, angle_deg, result.report.thickness_mm, {}};
  view.turn_deg = turn_deg;
  view.frame.axes = axes_of(side, angle_deg, turn_deg);
  view.frame.origin_in_lps = origin_of_plates(options, result.plates);
  return view;
}

}  // namespace mammotwin
