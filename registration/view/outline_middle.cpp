#include "registration/view/outline_middle.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace mammotwin {

double outline_middle_mm(const HermiteMesh& pressed, const ViewFrame& view) {
  constexpr int kAlongElement = 6;  // points, its ends among them: every 3 mm
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int n = 0; n < kAlongElement * kAlongElement * kAlongElement; ++n) {
    const Eigen::Array3d number(n % kAlongElement, n / kAlongElement % kAlongElement,
                                n / (kAlongElement * kAlongElement));
    const HermiteMesh::Weights weights = HermiteMesh::weights(number / (kAlongElement - 1));
    for (int e = 0; e < pressed.num_elements(); ++e) {
      const Eigen::Vector3d x = view.view_from_lps(pressed.interpolate(e, weights));
      if (x.x() <= 0) continue;
      low = std::min(low, x.y());
      high = std::max(high, x.y());
    }
  }
  if (!(low <= high))
    throw std::invalid_argument("nothing of the breast lies in front of the detector's edge");
  return (low + high) / 2;
}

}  // namespace mammotwin
