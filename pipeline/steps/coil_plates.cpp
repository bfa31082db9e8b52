#include "pipeline/steps/coil_plates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pipeline/steps/skin_samples.h"
#include "solver/contact/plate_placement.h"

namespace mammotwin {
namespace {

constexpr int kPatchSamples = 6;  // of a face along each of its sides
constexpr double kOffPlane_mm = 1, kPlaneTurn_deg = 6, kTowardsSide_deg = 45;
constexpr double kParallel_deg = 12, kOpposite_deg = 45;
// Of the breast's volume to the power 2/3. The smaller of the two patches has 0.05 at most on 86
// drawn breasts that hang free, 0.17 to 0.28 on six real ones between a coil's plates; 0 to 0.14
// on 22 others, of which some lie against such plates.
constexpr double kLeastPatch = 0.12;
constexpr double kMm2PerCm2 = 100;

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

/// Part of the skin that lies in one plane.
struct PlanePatch {
  Eigen::Vector3d middle_in_lps = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  ///< unit normal
  double area_cm2 = 0;
};

/// Of the skin that faces one side.
std::vector<SkinSample> side_samples(const MeshFile& imaged, double towards_left) {
  std::vector<SkinSample> samples = skin_samples(imaged, kPatchSamples);
  std::erase_if(samples, [&](const SkinSample& s) {
    return s.outward.x() * towards_left <= cosine(kTowardsSide_deg);
  });
  return samples;
}

/// The patch round each sample of a side.
std::vector<PlanePatch> plane_patches(const std::vector<SkinSample>& samples) {
  std::vector<PlanePatch> patches;
  for (const SkinSample& seed : samples) {
    PlanePatch patch;
    for (const SkinSample& s : samples) {
      if (std::abs(seed.outward.dot(s.x - seed.x)) > kOffPlane_mm ||
          seed.outward.dot(s.outward) < cosine(kPlaneTurn_deg))
        continue;
      patch.middle_in_lps += s.area * s.x;
      patch.outward += s.area * s.outward;
      patch.area_cm2 += s.area / kMm2PerCm2;
    }
    patch.middle_in_lps /= patch.area_cm2 * kMm2PerCm2;
    patch.outward.normalize();
    patches.push_back(patch);
  }
  return patches;
}

/// Do they lie opposite each other in parallel planes?
bool face_each_other(const PlanePatch& left, const PlanePatch& right) {
  const Eigen::Vector3d across = (left.outward - right.outward).normalized();
  return -left.outward.dot(right.outward) > cosine(kParallel_deg) &&
         across.dot((left.middle_in_lps - right.middle_in_lps).normalized()) >
             cosine(kOpposite_deg);
}

struct FacingPatches {
  PlanePatch left, right;
  Eigen::Vector3d across = Eigen::Vector3d::Zero();  ///< unit, to the left
};

/// The two that face each other of which the smaller, and then the larger, is largest; of no area
/// where none do. Many are nearly as large, and which is largest hangs on single samples, so the
/// direction is that of all, the larger ones before the others.
FacingPatches facing_patches(const MeshFile& imaged) {
  constexpr double preference = 8;
  const std::vector<PlanePatch> left = plane_patches(side_samples(imaged, 1)),
                                right = plane_patches(side_samples(imaged, -1));
  FacingPatches found;
  std::pair<double, double> largest(0, 0);
  for (const PlanePatch& l : left)
    for (const PlanePatch& r : right) {
      if (!face_each_other(l, r)) continue;
      const std::pair<double, double> areas = std::minmax(l.area_cm2, r.area_cm2);
      found.across += std::pow(areas.first, preference) * (l.outward - r.outward);
      if (areas <= largest) continue;
      largest = areas;
      found.left = l, found.right = r;
    }
  found.across.normalize();
  return found;
}

/// [mm³]
double volume_of(const HermiteMesh& mesh) {
  return volume_in_front(mesh, Eigen::Vector3d::UnitX(), -std::numeric_limits<double>::infinity());
}

}  // namespace

std::optional<CoilPlates> find_coil_plates(const MeshFile& imaged) {
  const auto [left, right, across] = facing_patches(imaged);
  const double face_cm2 = std::pow(volume_of(imaged.mesh), 2.0 / 3) / kMm2PerCm2;
  if (std::min(left.area_cm2, right.area_cm2) < kLeastPatch * face_cm2) return std::nullopt;
  return CoilPlates{across, left.area_cm2, right.area_cm2,
                    across.dot(left.middle_in_lps - right.middle_in_lps)};
}

}  // namespace mammotwin
