#include "pipeline/report/drawing/breast_window.h"

#include <algorithm>

#include "registration/carry/position_grid.h"

namespace mammotwin {
namespace {

constexpr double kMargin_mm = 12;
constexpr double kDarkest = 0.01, kBrightest = 0.995;

Eigen::AlignedBox3d extent(const Volume<std::uint8_t>& grid) {
  const Eigen::Vector3i last = grid.size - Eigen::Vector3i::Ones();
  return {grid.origin, grid.position(last.x(), last.y(), last.z())};
}

}  // namespace

Eigen::AlignedBox3d breast_box(const PatientResults& results) {
  const Eigen::AlignedBox3d image = extent(results.segmentation->labels);
  Eigen::AlignedBox3d box;
  if (results.prone) {
    box = bounding_box(results.prone->mesh);
  } else {
    const BreastRegion& region = results.segmentation->region;
    box = Eigen::AlignedBox3d(Eigen::Vector3d(region.x_min, image.min().y(), region.z_min),
                              Eigen::Vector3d(region.x_max, image.max().y(), region.z_max));
  }
  for (const Landmark& lesion : results.lesions()) box.extend(lesion.prone_in_lps);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin_mm);
  return Eigen::AlignedBox3d((box.min() - margin).eval(), (box.max() + margin).eval())
      .intersection(image);
}

double GreyWindow::of(float value) const {
  return std::clamp((static_cast<double>(value) - low) / (high - low), 0.0, 1.0);
}

GreyWindow grey_window(const Volume<float>& image, const Eigen::AlignedBox3d& box) {
  std::vector<float> values;
  const Eigen::Vector3i low = image.index(box.min()).array().ceil().cast<int>().max(0);
  const Eigen::Vector3i high =
      image.index(box.max()).cast<int>().cwiseMin(image.size - Eigen::Vector3i::Ones());
  for (int k = low.z(); k <= high.z(); k += 2)
    for (int j = low.y(); j <= high.y(); j += 2)
      for (int i = low.x(); i <= high.x(); i += 2) values.push_back(image(i, j, k));
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double f) {
    return values[static_cast<std::size_t>(f * (values.size() - 1))];
  };
  return {at(kDarkest), std::max(at(kBrightest), at(kDarkest) + 1e-6f)};
}

}  // namespace mammotwin
