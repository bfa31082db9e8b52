#include "registration/view/breast_middle.h"

#include <Eigen/LU>
#include <stdexcept>

namespace mammotwin {

double breast_middle_mm(const HermiteMesh& pressed, const ViewFrame& view) {
  constexpr int kAlongElement = 6;  // every 3 mm
  double moment = 0, volume = 0;
  for (int e = 0; e < pressed.num_elements(); ++e)
    for (int n = 0; n < kAlongElement * kAlongElement * kAlongElement; ++n) {
      const Eigen::Array3d number(n % kAlongElement, n / kAlongElement % kAlongElement,
                                  n / (kAlongElement * kAlongElement));
      const MeshPoint p{e, (number + 0.5) / kAlongElement};
      const Eigen::Vector3d x = view.view_from_lps(pressed.position(p));
      if (x.x() <= 0) continue;
      const double piece = pressed.jacobian(p).determinant();
      moment += piece * x.y();
      volume += piece;
    }
  if (!(volume > 0))
    throw std::invalid_argument("nothing of the breast lies in front of the detector's edge");
  return moment / volume;
}

}  // namespace mammotwin
