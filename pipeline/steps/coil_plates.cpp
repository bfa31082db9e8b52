#include "pipeline/steps/coil_plates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/element/face.h"

namespace mammotwin {
namespace {

constexpr int kPatchSamples = 6;  // of a face along each of its sides
constexpr double kOffPlane_mm = 1, kPlaneTurn_deg = 6, kTowardsSide_deg = 45;
// Of 20 breasts of label maps none has both sides plane over 25 cm2 and parallel within 10 degrees;
// of a breast between a coil's plates they are 36 and 39 cm2, and parallel within 1.
constexpr double kLeastArea_cm2 = 25, kParallel_deg = 8;
constexpr double kMm2PerCm2 = 100;

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

/// Part of the skin that lies in one plane.
struct PlanePatch {
  Eigen::Vector3d middle_in_lps = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  ///< unit normal
  double area_cm2 = 0;
};

struct SkinSample {
  Eigen::Vector3d x, outward;
  double area;  ///< [mm²]
};

SkinSample sample_at(const HermiteMesh& mesh, int element, int face, const Eigen::Vector3d& xi) {
  const Eigen::Matrix3d J = mesh.jacobian({element, xi});
  const auto [a, b] = face_directions(face);
  Eigen::Vector3d normal = J.col(a).cross(J.col(b));
  if (normal.dot(J.col(face / 2)) * (face % 2 ? 1 : -1) < 0) normal = -normal;
  return {mesh.position({element, xi}), normal.normalized(),
          normal.norm() / (kPatchSamples * kPatchSamples)};
}

/// Of the skin that faces one side.
std::vector<SkinSample> side_samples(const MeshFile& imaged, double towards_left) {
  std::vector<SkinSample> samples;
  for (int e = 0; e < imaged.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      for (int k = 0; imaged.faces[e][face] == FaceLabel::skin && k < kPatchSamples * kPatchSamples;
           ++k) {
        const SkinSample sample =
            sample_at(imaged.mesh, e, face,
                      point_on_face(face, (k % kPatchSamples + 0.5) / kPatchSamples,
                                    (k / kPatchSamples + 0.5) / kPatchSamples));
        if (sample.outward.x() * towards_left > cosine(kTowardsSide_deg)) samples.push_back(sample);
      }
  return samples;
}

/// The largest that faces a side; of no area where no skin faces there.
PlanePatch plane_patch(const MeshFile& imaged, double towards_left) {
  const std::vector<SkinSample> samples = side_samples(imaged, towards_left);
  PlanePatch largest;
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
    if (patch.area_cm2 > largest.area_cm2) largest = patch;
  }
  if (largest.area_cm2 > 0) {
    largest.middle_in_lps /= largest.area_cm2 * kMm2PerCm2;
    largest.outward.normalize();
  }
  return largest;
}

}  // namespace

std::optional<CoilPlates> find_coil_plates(const MeshFile& imaged) {
  const PlanePatch left = plane_patch(imaged, 1), right = plane_patch(imaged, -1);
  if (std::min(left.area_cm2, right.area_cm2) < kLeastArea_cm2 ||
      -left.outward.dot(right.outward) < cosine(kParallel_deg))
    return std::nullopt;
  const Eigen::Vector3d across = (left.outward - right.outward).normalized();
  return CoilPlates{{left.middle_in_lps, left.outward},
                    {right.middle_in_lps, right.outward},
                    left.area_cm2,
                    right.area_cm2,
                    across.dot(left.middle_in_lps - right.middle_in_lps)};
}

SkinPressure pressure_of(const CoilPlates& plates, double pressure_kpa) {
  return [plates, pressure_kpa](const Eigen::Vector3d& x, const Eigen::Vector3d& outward) {
    double share = 0;
    for (const CoilPlates::Plate& plate : {plates.left, plates.right}) {
      const double off_mm = std::abs(plate.outward.dot(x - plate.point_in_lps));
      const double turn_deg =
          std::acos(std::clamp(plate.outward.dot(outward), -1.0, 1.0)) * 180 / std::numbers::pi;
      const double off = std::max(off_mm / kOffPlane_mm, turn_deg / kPlaneTurn_deg);
      share = std::max(share, std::clamp(2 - off, 0.0, 1.0));
    }
    return pressure_kpa * share;
  };
}

}  // namespace mammotwin
