#include "pipeline/evaluate/segmentation/mri_changes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/evaluate/cases/spline_resampled.h"
#include "pipeline/synthesize/counter_random.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/flipped.h"
#include "segmentation/image/otsu.h"

namespace mammotwin {
namespace {

using Place = Eigen::Vector3d;
using Grey = Volume<float>;

Place extent_of(const Grey& image) { return image.spacing.cwiseProduct(image.size.cast<double>()); }

Place middle_of(const Grey& image) { return image.origin + (extent_of(image) - image.spacing) / 2; }

ChangedMri mirrored_mri(const Grey& image) {
  const double twice = 2 * middle_of(image).x();
  return {flipped(image), true, [twice](const Place& x) -> Place {
            return {twice - x.x(), x.y(), x.z()};
          }};
}

ChangedMri turned_mri(const Grey& image, const Place& axis, double deg) {
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(deg * std::numbers::pi / 180, axis));
  const Place middle = middle_of(image);
  const auto back = [&](const Place& x) -> Place {
    return middle + turn.transpose() * (x - middle);
  };
  return {spline_resampled(image, image, back, Beyond::border), false,
          [=](const Place& x) -> Place { return middle + turn * (x - middle); }};
}

/// With voxels `larger` times as large, the first of them half an old one and `off` old ones in.
ChangedMri on_other_grid(const Grey& image, double larger, double off) {
  const Place spacing = larger * image.spacing;
  const Eigen::Vector3i size =
      (extent_of(image).cwiseQuotient(spacing).array() - off).floor().cast<int>();
  const Grey grid(size, spacing, image.origin + (spacing - image.spacing) / 2 + off * spacing);
  return {spline_resampled(
      image, grid, [](const Place& x) { return x; }, Beyond::border)};
}

ChangedMri cut_mri(const Grey& image, double mm) {
  const int slices = static_cast<int>(std::round(mm / image.spacing.z()));
  return {cropped(image, {0, 0, slices},
                  {image.size.x() - 1, image.size.y() - 1, image.size.z() - 1 - slices})};
}

/// Slices of `mm` across an axis, each the mean of what it covers.
ChangedMri thick_mri(const Grey& image, int axis, double mm) {
  const double step = image.spacing[axis];
  Eigen::Vector3i size = image.size;
  size[axis] = static_cast<int>(image.size[axis] * step / mm);
  Place spacing = image.spacing, origin = image.origin;
  spacing[axis] = mm;
  origin[axis] += (mm - step) / 2;
  Grey out(size, spacing, origin, 0);
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) {
        Eigen::Vector3i v(i, j, k);
        const double low = v[axis] * mm / step, high = (v[axis] + 1) * mm / step;
        double sum = 0;
        for (int n = static_cast<int>(low); n < std::min<double>(image.size[axis], high); ++n) {
          v[axis] = n;
          sum += image(v.x(), v.y(), v.z()) *
                 (std::min<double>(high, n + 1) - std::max<double>(low, n));
        }
        out(i, j, k) = static_cast<float>(sum / (high - low));
      }
  return {std::move(out)};
}

ChangedMri alone_mri(const Grey& image, Side breast) {
  constexpr double beyond_mm = 15;
  const double middle = (image.size.x() - 1) / 2.0, beyond = beyond_mm / image.spacing.x();
  Eigen::Vector3i low(0, 0, 0), high = image.size - Eigen::Vector3i::Ones();
  if (breast == Side::left)
    low.x() = std::max(0, static_cast<int>(middle - beyond));
  else
    high.x() = std::min(high.x(), static_cast<int>(middle + beyond));
  return {cropped(image, low, high)};
}

/// `value(grey, share of the way along each axis, voxel)` for each voxel.
template <class Value>
ChangedMri revalued(Grey image, const Value& value) {
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const Place share =
            Place(i + 0.5, j + 0.5, k + 0.5).cwiseQuotient(image.size.cast<double>());
        image(i, j, k) = static_cast<float>(value(image(i, j, k), share, image.offset(i, j, k)));
      }
  return {std::move(image)};
}

ChangedMri shaded_mri(const Grey& image, int axis) {
  return revalued(image, [axis](double grey, const Place& share, std::size_t) {
    return grey * (1.25 - 0.5 * share[axis]);
  });
}

/// The mean of what is no air.
double tissue_of(const Grey& image) {
  const double border =
      otsu_threshold(image.values, *std::max_element(image.values.begin(), image.values.end()));
  double sum = 0;
  std::size_t count = 0;
  for (const float grey : image.values)
    if (grey > border) sum += grey, ++count;
  return sum / static_cast<double>(std::max<std::size_t>(count, 1));
}

/// Magnitudes of a value with noise of this share of tissue in both its parts.
ChangedMri noisy_mri(const Grey& image, double of_tissue) {
  const double sd = of_tissue * tissue_of(image);
  return revalued(image, [sd](double grey, const Place&, std::size_t voxel) {
    CounterRandom random(7, voxel);
    const double real = grey + sd * random.normal(), imaginary = sd * random.normal();
    return std::hypot(real, imaginary);
  });
}

ChangedMri bent_mri(const Grey& image, double power) {
  const double tissue = tissue_of(image);
  return revalued(image, [=](double grey, const Place&, std::size_t) {
    return tissue * std::pow(std::max(0.0, grey) / tissue, power);
  });
}

}  // namespace

std::vector<MriChange> mri_changes() {
  const Place s = Place::UnitZ(), l = Place::UnitX();
  return {
      {"mirror", [](const Grey& image, Side) { return mirrored_mri(image); }},
      {"turn_5", [s](const Grey& image, Side) { return turned_mri(image, s, 5); }},
      {"turn_-5", [s](const Grey& image, Side) { return turned_mri(image, s, -5); }},
      {"head_up_5", [l](const Grey& image, Side) { return turned_mri(image, l, 5); }},
      {"half_voxel", [](const Grey& image, Side) { return on_other_grid(image, 1, 0.5); }},
      {"voxel_0.8", [](const Grey& image, Side) { return on_other_grid(image, 0.8, 0); }},
      {"voxel_1.3", [](const Grey& image, Side) { return on_other_grid(image, 1.3, 0); }},
      {"cut_12", [](const Grey& image, Side) { return cut_mri(image, 12); }},
      {"noise_3", [](const Grey& image, Side) { return noisy_mri(image, 0.03); }},
      {"shaded_l", [](const Grey& image, Side) { return shaded_mri(image, 0); }},
      {"shaded_p", [](const Grey& image, Side) { return shaded_mri(image, 1); }},
      {"power_0.8", [](const Grey& image, Side) { return bent_mri(image, 0.8); }},
      {"slices_l", [](const Grey& image, Side) { return thick_mri(image, 0, 2.5); }},
      {"slices_p", [](const Grey& image, Side) { return thick_mri(image, 1, 2.5); }},
      {"slices_s", [](const Grey& image, Side) { return thick_mri(image, 2, 2.5); }},
      {"alone", alone_mri},
  };
}

}  // namespace mammotwin
