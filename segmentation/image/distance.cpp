#include "segmentation/image/distance.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

namespace mammotwin {
namespace {

constexpr float far = 1e12F;  // squared [mm^2]

/// Lower envelope of parabolas along one line: d[q] = min_p (step (q - p))^2 + f[p].
class LineTransform {
 public:
  LineTransform(int n, double step) : squared_step_(step * step), f(n), at_(n), from_(n + 1) {}

  std::vector<float>& values() { return f; }

  template <class Write>
  void operator()(const Write& write) {
    const int n = static_cast<int>(f.size());
    int k = -1;
    for (int q = 0; q < n; ++q) {
      if (f[q] >= far) continue;
      double s = -INFINITY;
      while (k >= 0 && (s = meet(at_[k], q)) <= from_[k]) --k;
      if (k < 0) s = -INFINITY;
      at_[++k] = q;
      from_[k] = s;
    }
    if (k < 0) {
      for (int q = 0; q < n; ++q) write(q, far);
      return;
    }
    for (int q = 0, p = 0; q < n; ++q) {
      while (p < k && from_[p + 1] < q) ++p;
      const double t = q - at_[p];
      write(q, static_cast<float>(squared_step_ * t * t + f[at_[p]]));
    }
  }

 private:
  double meet(int p, int q) const {
    const double rise = (static_cast<double>(f[q]) - f[p]) / squared_step_;
    return (rise + (static_cast<double>(q) * q - static_cast<double>(p) * p)) / (2.0 * (q - p));
  }

  double squared_step_;
  std::vector<float> f;
  std::vector<int> at_;
  std::vector<double> from_;
};

/// Transforms all lines along one axis in place.
void along_axis(Volume<float>& d, int axis) {
  const Eigen::Vector3i n = d.size;
  const std::size_t step[3] = {1, static_cast<std::size_t>(n.x()),
                               static_cast<std::size_t>(n.x()) * n.y()};
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  tbb::parallel_for(0, n[c], [&](int w) {
    LineTransform line(n[axis], d.spacing[axis]);
    for (int v = 0; v < n[b]; ++v) {
      float* first = d.values.data() + v * step[b] + w * step[c];
      for (int q = 0; q < n[axis]; ++q) line.values()[q] = first[q * step[axis]];
      line([&](int q, float value) { first[q * step[axis]] = value; });
    }
  });
}

/// Steps from a voxel to all voxels whose centres lie within `radius` mm.
std::vector<Eigen::Vector3i> ball(const Eigen::Vector3d& spacing, double radius) {
  const Eigen::Vector3i reach = (radius / spacing.array()).floor().cast<int>().matrix();
  std::vector<Eigen::Vector3i> steps;
  for (int c = -reach.z(); c <= reach.z(); ++c)
    for (int b = -reach.y(); b <= reach.y(); ++b)
      for (int a = -reach.x(); a <= reach.x(); ++a)
        if (spacing.cwiseProduct(Eigen::Vector3d(a, b, c)).norm() <= radius)
          steps.emplace_back(a, b, c);
  return steps;
}

/// A voxel of the mask with a neighbour outside it: from these the nearest is always one.
bool is_on_border(const Volume<std::uint8_t>& mask, int i, int j, int k) {
  const auto out = [&](int a, int b, int c) { return mask.contains(a, b, c) && !mask(a, b, c); };
  return mask(i, j, k) && (out(i - 1, j, k) || out(i + 1, j, k) || out(i, j - 1, k) ||
                           out(i, j + 1, k) || out(i, j, k - 1) || out(i, j, k + 1));
}

Volume<std::uint8_t> inverted(Volume<std::uint8_t> mask) {
  for (std::uint8_t& value : mask.values) value = !value;
  return mask;
}

}  // namespace

Volume<float> distance_to(const Volume<std::uint8_t>& mask) {
  auto d = mask.like<float>(far);
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    if (mask.values[v]) d.values[v] = 0;
  for (int axis = 0; axis < 3; ++axis) along_axis(d, axis);
  for (float& value : d.values) value = std::sqrt(value);
  return d;
}

Volume<std::uint8_t> dilated(const Volume<std::uint8_t>& mask, double radius) {
  const std::vector<Eigen::Vector3i> steps = ball(mask.spacing, radius);
  auto out = mask;
  for (int k = 0; k < mask.size.z(); ++k)
    for (int j = 0; j < mask.size.y(); ++j)
      for (int i = 0; i < mask.size.x(); ++i) {
        if (!is_on_border(mask, i, j, k)) continue;
        for (const Eigen::Vector3i& s : steps)
          if (mask.contains(i + s.x(), j + s.y(), k + s.z()))
            out(i + s.x(), j + s.y(), k + s.z()) = 1;
      }
  return out;
}

Volume<std::uint8_t> eroded(const Volume<std::uint8_t>& mask, double radius) {
  return inverted(dilated(inverted(mask), radius));
}

Volume<std::uint8_t> opened(const Volume<std::uint8_t>& mask, double radius) {
  return dilated(eroded(mask, radius), radius);
}

Volume<std::uint8_t> closed(const Volume<std::uint8_t>& mask, double radius) {
  return eroded(dilated(mask, radius), radius);
}

}  // namespace mammotwin
