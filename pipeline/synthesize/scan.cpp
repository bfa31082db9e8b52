#include "pipeline/synthesize/scan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/drawn_vessels.h"
#include "pipeline/synthesize/implicit.h"
#include "pipeline/synthesize/lattice_noise.h"
#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

template <class Body>
void for_voxels(const Vector3i& size, const Body& body) {
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) body(i, j, k);
  });
}

constexpr double blood_before_agent = 0.4;  // of fat, not suppressed: as the heart

/// Relative variation of intensity inside materials, 0 in the mean.
class Texture {
 public:
  Texture(std::uint64_t seed, double strength)
      : strength_(strength),
        septa_(seed, 81, 15),
        fine_septa_(seed, 82, 6),
        patches_(seed, 84, 12),
        mottle_(seed, 83, 3.5) {}

  double fat(const Vector3d& x) const {  // bright sheets where a noise crosses zero
    if (strength_ == 0) return 0;
    const double broad = 1 - std::min(1.0, std::abs(septa_(x)) / 0.08);
    const double thin = 1 - std::min(1.0, std::abs(fine_septa_(x)) / 0.10);
    const double here = std::clamp(0.5 + 1.5 * patches_(x), 0.0, 1.0);  // septa come and go
    return strength_ * (here * (0.26 * broad + 0.16 * thin) + 0.10 * mottle_(x) - 0.05);
  }
  double gland(const Vector3d& x) const {
    return strength_ == 0 ? 0 : strength_ * 0.32 * mottle_(x);
  }
  double other(const Vector3d& x) const {
    return strength_ == 0 ? 0 : strength_ * 0.12 * mottle_(x);
  }

 private:
  double strength_;
  LatticeNoise septa_, fine_septa_, patches_, mottle_;
};

/// Factor on fat where suppression fails: 1 outside an ellipsoid of 44 x 76 x 90 mm, 3.2 inside.
double unsuppressed(const Vector3d& from_patch) {
  const double r = from_patch.cwiseQuotient(Vector3d(22, 38, 45)).norm();
  return 1 + 2.2 * (1 - smooth_step(0.8, 1.2, r));
}

Volume<float> signal_of(const TissueMap& tissue, const ScanOptions& o, std::uint64_t seed,
                        const Vector3d& failed_patch) {
  const auto level = intensities(o);
  const Texture texture(seed, o.texture);
  Volume<float> signal = tissue.mixtures.like<float>();
  const bool patch = o.failed_suppression && o.contrast == ScanContrast::fat_suppressed;
  for_voxels(signal.size, [&](int i, int j, int k) {
    const VoxelMixture& m = tissue.mixtures(i, j, k);
    if (m[Substance::air] == tissue.parts_per_voxel) return;
    const Vector3d x = signal.position(i, j, k);
    double sum = 0;
    for (int n = 0; n < num_substances; ++n) {
      if (m.parts[n] == 0) continue;
      const auto material = static_cast<Substance>(n);
      double part = m.parts[n] * level[n];
      if (material == Substance::fat)
        part *= (1 + texture.fat(x)) * (patch ? unsuppressed(x - failed_patch) : 1);
      else if (material == Substance::fibroglandular)
        part *= 1 + texture.gland(x);
      else
        part *= 1 + texture.other(x);
      sum += part;
    }
    signal(i, j, k) = static_cast<float>(sum / tissue.parts_per_voxel);
  });
  return signal;
}

std::vector<float> gaussian(double sigma) {
  const int reach = static_cast<int>(std::ceil(4 * sigma));
  std::vector<float> weights(2 * reach + 1);
  double sum = 0;
  for (int n = -reach; n <= reach; ++n) sum += std::exp(-n * n / (2 * sigma * sigma));
  for (int n = -reach; n <= reach; ++n)
    weights[n + reach] = static_cast<float>(std::exp(-n * n / (2 * sigma * sigma)) / sum);
  return weights;
}

Volume<float> blur_along(const Volume<float>& in, const std::vector<float>& weights, int axis) {
  Volume<float> out = in.like<float>();
  const int reach = static_cast<int>(weights.size() / 2);
  for_voxels(in.size, [&](int i, int j, int k) {
    float sum = 0;
    for (int n = -reach; n <= reach; ++n) {
      Vector3i at(i, j, k);
      at[axis] = std::clamp(at[axis] + n, 0, in.size[axis] - 1);
      sum += weights[n + reach] * in(at.x(), at.y(), at.z());
    }
    out(i, j, k) = sum;
  });
  return out;
}

double shading_ratio(const Volume<float>& shading, const TissueMap& tissue) {
  std::vector<float> body;
  for (std::size_t n = 0; n < shading.values.size(); ++n)
    if (tissue.mixtures.values[n][Substance::air] == 0) body.push_back(shading.values[n]);
  if (body.empty()) return 1;
  return quantile(body, 0.99) / quantile(body, 0.01);
}

}  // namespace

namespace {

std::array<double, num_substances> usual_intensities(const ScanOptions& o) {
  //      air skin fat  gland lesion                muscle rib  lung  heart liver
  if (o.contrast == ScanContrast::fat_suppressed)
    return {0, 2.0, 1.0, 1.8, 1.8 * o.lesion_to_gland, 1.55, 0.95, 0.25, 1.4, 1.3};
  if (o.contrast_agent)  // gland takes up a tenth, a lesion doubles, blood is bright
    return {0, 0.5, 1.0, 0.5, 0.5 * o.lesion_to_gland, 0.44, 0.8, 0.06, 0.8, 0.7};
  return {0, 0.45, 1.0, 0.45, 0.42, 0.40, 0.8, 0.06, 0.4, 0.5};
}

/// Copies of the body that movement leaves along x, in bands of slices that come and go.
void add_ghosts(double strength, std::uint64_t seed, Volume<float>& signal) {
  constexpr double shift_share = 0.45;  // of the field of view
  const Volume<float> body = signal;
  const int shift = static_cast<int>(shift_share * signal.size.x());
  const LatticeNoise bands(seed, 93, 40);
  for_voxels(signal.size, [&](int i, int j, int k) {
    const double here = std::clamp(0.5 + bands(Vector3d(0, 0, body.position(0, 0, k).z())), 0., 1.);
    const double copies = (i >= shift ? body(i - shift, j, k) : 0) +
                          (i + shift < body.size.x() ? body(i + shift, j, k) : 0);
    signal(i, j, k) += static_cast<float>(strength * here * copies);
  });
}

}  // namespace

std::array<double, num_substances> intensities(const ScanOptions& o) {
  auto level = usual_intensities(o);
  const auto set = [&](Substance s, double value) { level[static_cast<int>(s)] = value; };
  if (o.muscle_to_fat > 0) set(Substance::muscle, o.muscle_to_fat);
  if (o.organs_to_fat > 0)
    set(Substance::heart, o.organs_to_fat), set(Substance::liver, o.organs_to_fat);
  return level;
}

double coil_radius_mm(ScanContrast contrast) {
  return contrast == ScanContrast::fat_suppressed ? 85 : 70;
}

Scan scan(const TissueMap& tissue, const Coil& coil, const ScanOptions& o, std::uint64_t seed,
          const Vector3d& failed_patch) {
  Volume<float> signal = signal_of(tissue, o, seed, failed_patch);
  const bool with_agent = o.contrast == ScanContrast::fat_suppressed || o.contrast_agent;
  if (o.vessels_to_fat > 0)
    draw_vessels(with_agent ? o.vessels_to_fat : blood_before_agent, seed, tissue, signal);
  if (o.blur_voxels > 0) {
    const auto weights = gaussian(o.blur_voxels);
    for (int axis = 0; axis < 3; ++axis) signal = blur_along(signal, weights, axis);
  }
  if (o.ghosts > 0) add_ghosts(o.ghosts, seed, signal);
  const Volume<float> shading = coil.shading(signal, o.shading);
  Scan result{signal.like<std::int16_t>(), shading_ratio(shading, tissue)};
  for_voxels(signal.size, [&](int i, int j, int k) {
    const std::size_t n = signal.offset(i, j, k);
    // A voxel draws two normals: eight words. The second image of a body has noise of its own.
    CounterRandom random(seed, o.contrast_agent ? 92 : 91, 8 * n);
    const double real =
        static_cast<double>(signal.values[n]) * shading.values[n] + o.noise * random.normal();
    const double imaginary = o.noise * random.normal();
    const double magnitude = std::sqrt(real * real + imaginary * imaginary);
    result.image.values[n] =
        static_cast<std::int16_t>(std::min(std::floor(fat_grey * magnitude + 0.5), 32767.0));
  });
  return result;
}

}  // namespace mammotwin
