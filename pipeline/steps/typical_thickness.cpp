#include "pipeline/steps/typical_thickness.h"

#include <algorithm>
#include <array>

namespace mammotwin {
namespace {

constexpr double kMm3PerMl = 1000;
constexpr double kThinnest_mm = 30, kStep_mm = 10;
/// Volumes [ml] of the mean breast at 30, 40, ... 90 mm.
constexpr std::array kVolumes = {231.8, 360.4, 520.3, 715.0, 947.8, 1222.2, 1541.7};
constexpr double kLeastShare = 0.25, kMostShare = 0.6;  // of the free extent

}  // namespace

double typical_thickness_mm(double volume_ml) {
  const double volume = std::clamp(volume_ml, kVolumes.front(), kVolumes.back());
  std::size_t n = 1;
  while (n + 1 < kVolumes.size() && volume > kVolumes[n]) ++n;
  return kThinnest_mm +
         kStep_mm * (n - 1 + (volume - kVolumes[n - 1]) / (kVolumes[n] - kVolumes[n - 1]));
}

double assumed_thickness_mm(const MeshFile& imaged, const PlateOptions& plates) {
  const PlateFrame frame(imaged, plates);
  const double free = frame.free_extent();
  return std::clamp(typical_thickness_mm(frame.volume_in_front() / kMm3PerMl), kLeastShare * free,
                    kMostShare * free);
}

}  // namespace mammotwin
