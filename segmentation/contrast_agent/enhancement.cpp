#include "segmentation/contrast_agent/enhancement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "segmentation/image/components.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

constexpr double least_cover = 0.9;
constexpr float most = 5;
constexpr float doubled = 1;  // (post - pre) / pre
constexpr double smoothing_mm = 1, least_ml = 0.05, most_ml = 40;
constexpr std::size_t most_candidates = 10;

void check_cover(const Volume<float>& post, const Volume<float>& pre) {
  const Eigen::Vector3d low = post.position(0, 0, 0).cwiseMax(pre.position(0, 0, 0));
  const Eigen::Vector3i a = post.size - Eigen::Vector3i::Ones(),
                        b = pre.size - Eigen::Vector3i::Ones();
  const Eigen::Vector3d end = post.position(a.x(), a.y(), a.z());
  const Eigen::Vector3d high = end.cwiseMin(pre.position(b.x(), b.y(), b.z()));
  const Eigen::Vector3d both = (high - low).cwiseMax(0), all = end - post.position(0, 0, 0);
  const double cover = both.prod() / all.prod();
  if (cover < least_cover)
    throw std::runtime_error("the image before contrast agent covers " +
                             std::to_string(static_cast<int>(100 * cover)) +
                             " % of the one after it; expected 90 % at least (are both of one "
                             "examination?)");
}

}  // namespace

Volume<float> on_grid_of(const Volume<float>& post, const Volume<float>& pre) {
  check_cover(post, pre);
  auto out = post.like<float>(0);
  tbb::parallel_for(0, post.size.z(), [&](int k) {
    for (int j = 0; j < post.size.y(); ++j)
      for (int i = 0; i < post.size.x(); ++i)
        out(i, j, k) = interpolated(pre, post.position(i, j, k));
  });
  return out;
}

Volume<float> relative_enhancement(const Volume<float>& post, const Volume<float>& pre,
                                   double noise) {
  const auto floor = static_cast<float>(std::max(3 * noise, 1e-6));
  auto out = post.like<float>(0);
  for (std::size_t v = 0; v < out.values.size(); ++v) {
    const float before = pre.values[v];
    out.values[v] = std::clamp((post.values[v] - before) / std::max(before, floor), 0.0F, most);
  }
  return out;
}

std::vector<LesionCandidate> find_candidates(const Volume<float>& enhancement,
                                             const Volume<std::uint8_t>& allowed) {
  const Volume<float> smooth = gaussian_smoothed(enhancement, smoothing_mm);
  auto strong = allowed;
  for (std::size_t v = 0; v < strong.values.size(); ++v)
    strong.values[v] = allowed.values[v] && smooth.values[v] > doubled;
  const Components parts = connected_components(strong);
  std::vector<LesionCandidate> all(parts.sizes.size());
  for (int k = 0; k < strong.size.z(); ++k)
    for (int j = 0; j < strong.size.y(); ++j)
      for (int i = 0; i < strong.size.x(); ++i) {
        LesionCandidate& c = all[parts.ids(i, j, k)];
        c.centroid_in_lps += strong.position(i, j, k);
        c.enhancement += enhancement(i, j, k);
      }
  std::vector<LesionCandidate> found;
  for (std::size_t n = 1; n < all.size(); ++n) {
    const double ml = static_cast<double>(parts.sizes[n]) * strong.voxel_volume() / 1000;
    if (ml < least_ml || ml > most_ml) continue;
    const auto voxels = static_cast<double>(parts.sizes[n]);
    found.push_back({all[n].centroid_in_lps / voxels, ml, all[n].enhancement / voxels});
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.volume_ml * a.enhancement > b.volume_ml * b.enhancement;
  });
  if (found.size() > most_candidates) found.resize(most_candidates);
  return found;
}

}  // namespace mammotwin
