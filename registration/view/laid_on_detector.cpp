#include "registration/view/laid_on_detector.h"

namespace mammotwin {

CompressedView laid_on_detector(CompressedView view, double turn_deg,
                                const Eigen::Vector2d& shift_mm) {
  view.turn_deg += turn_deg;
  view.frame.axes = axes_of(view.side, view.angle_deg, view.turn_deg);
  view.frame.origin_in_lps -=
      view.frame.axes.transpose() * Eigen::Vector3d(shift_mm.x(), shift_mm.y(), 0);
  return view;
}

}  // namespace mammotwin
