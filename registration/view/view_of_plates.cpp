#include "registration/view/view_of_plates.h"

namespace mammotwin {

CompressedView view_of_plates(const std::string& name, Side side, double angle_deg, double turn_deg,
                              const PlateOptions& options, const CompressionResult& result) {
  CompressedView view{name, side, angle_deg, result.report.thickness_mm, {}};
  view.turn_deg = turn_deg;
  view.frame.axes = axes_of(side, angle_deg, turn_deg);
  const Eigen::Vector3d depth = options.depth, up = options.up;
  const Eigen::Vector3d across(depth.y() * up.z() - depth.z() * up.y(),
                               depth.z() * up.x() - depth.x() * up.z(),
                               depth.x() * up.y() - depth.y() * up.x());
  view.frame.origin_in_lps = depth * result.plates.edge + up * result.plates.support_height +
                             across * result.plates.lateral_middle;
  return view;
}

}  // namespace mammotwin
