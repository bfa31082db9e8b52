#include "segmentation/body/breast_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "segmentation/body/apices.h"

namespace mammotwin {
namespace {

constexpr double least_cleft_mm = 20;  // over the skin between the breasts

/// The middle of the voxels that lie most anterior.
Eigen::Vector3d most_anterior(const Volume<std::uint8_t>& body, const std::vector<double>& fronts,
                              int low, int high) {
  double foremost = -std::numeric_limits<double>::infinity();
  Eigen::Vector3d sum = body.position(low, body.size.y() - 1, 0);
  int count = 0;
  for (int k = 0; k < body.size.z(); ++k)
    for (int i = low; i <= high; ++i) {
      const double front = fronts[static_cast<std::size_t>(k) * body.size.x() + i];
      if (front < foremost || !std::isfinite(front)) continue;
      if (front > foremost) foremost = front, count = 0, sum.setZero();
      const Eigen::Vector3d column = body.position(i, 0, k);
      sum += Eigen::Vector3d(column.x(), -front, column.z());
      ++count;
    }
  return sum / std::max(count, 1);
}

/// The valley at the height of the apices: above and below, the chest lies further forward than
/// there, and not in its middle.
double valley_x(const Volume<std::uint8_t>& body, const std::vector<double>& fronts,
                const BreastFrame& frame) {
  constexpr double reach_mm = 10;
  const auto slice = [&](double z) {
    return std::clamp(static_cast<int>(std::lround((z - body.origin.z()) / body.spacing.z())), 0,
                      body.size.z() - 1);
  };
  const auto column = [&](const Eigen::Vector3d& x) {
    return static_cast<int>(std::lround((x.x() - body.origin.x()) / body.spacing.x()));
  };
  const double height = (frame.left_apex.z() + frame.right_apex.z()) / 2;
  const std::vector<double> front =
      front_profile(fronts, body.size.x(), slice(height - reach_mm), slice(height + reach_mm));
  const double valley = cleft_between(front, column(frame.right_apex), column(frame.left_apex));
  return body.origin.x() + valley * body.spacing.x();
}

/// Slices in which some column stands out enough, as an unbroken run around the apices.
void find_slices(const Volume<std::uint8_t>& body, const std::vector<double>& fronts,
                 BreastFrame& frame) {
  constexpr double least_mm = 12, least_share = 0.25;
  const double height = frame.sternal_y - frame.front_y;
  const double needed = std::max(least_mm, least_share * height);
  std::vector<bool> stands(body.size.z(), false);
  for (int k = 0; k < body.size.z(); ++k) {
    const auto first = fronts.begin() + static_cast<std::ptrdiff_t>(k) * body.size.x();
    stands[k] = frame.sternal_y + *std::max_element(first, first + body.size.x()) > needed;
  }
  const auto slice = [&](const Eigen::Vector3d& x) {
    return static_cast<int>((x.z() - body.origin.z()) / body.spacing.z() + 0.5);
  };
  int low = std::min(slice(frame.left_apex), slice(frame.right_apex));
  int high = std::max(slice(frame.left_apex), slice(frame.right_apex));
  while (low > 0 && stands[low - 1]) --low;
  while (high + 1 < body.size.z() && stands[high + 1]) ++high;
  frame.z_low = body.position(0, 0, low).z();
  frame.z_high = body.position(0, 0, high).z();
}

}  // namespace

BreastFrame find_breast_frame(const Volume<std::uint8_t>& body) {
  const std::vector<double> fronts =
      column_fronts(body, [&](int i, int j, int k) { return body(i, j, k) != 0; });
  const std::vector<double> front = front_profile(fronts, body.size.x(), 0, body.size.z() - 1);
  const auto apices = find_apices(front, body.spacing.x());
  if (!apices)
    throw std::runtime_error(
        "no breast found: the outline of the body has neither two breasts with a valley between "
        "them "
        "nor one that stands out beside the breastbone; expected a prone MRI of one or both (is "
        "the "
        "patient supine, or the image a part of a breast?)");
  BreastFrame frame;
  frame.sternal_y = -*std::min_element(front.begin() + apices->right, front.begin() + apices->left);
  frame.right_apex = most_anterior(body, fronts, 0, static_cast<int>(apices->valley));
  frame.left_apex =
      most_anterior(body, fronts, static_cast<int>(std::ceil(apices->valley)), body.size.x() - 1);
  frame.midline_x = valley_x(body, fronts, frame);
  frame.front_y = std::min(frame.left_apex.y(), frame.right_apex.y());
  if (frame.sternal_y - frame.front_y < least_cleft_mm)
    throw std::runtime_error(
        "no breast found: nothing stands 20 mm or more out from the skin at "
        "the middle; expected a prone breast MRI");
  find_slices(body, fronts, frame);
  return frame;
}

}  // namespace mammotwin
