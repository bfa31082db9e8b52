#include "pipeline/synthesize/coil_pressed.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <stdexcept>

#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/breast_reach.h"
#include "pipeline/synthesize/implicit.h"
#include "registration/carry/point_carrier.h"
#include "registration/carry/position_grid.h"
#include "segmentation/image/trilinear.h"
#include "solver/press/compress.h"

namespace mammotwin {
namespace {

constexpr double kClearance_mm = 5, kRounding_mm = 5;  // of the plates' rear edges
constexpr double kGoesAlong_mm = 60;                   // beside the mesh, less and less

/// Puts the plates' middle where that of the breast's front half is, and brings them together to
/// this share of its width.
void put_round_front_half(const MeshFile& prone, double share, PlateOptions& plates) {
  const auto [wall, tip] = breast_reach(prone, plates.depth);
  PlateOptions halfway = plates;
  halfway.wall_clearance = std::max(0.0, (tip - wall) / 2 - plates.rounding);
  const PlateFrame front_half(prone, halfway);
  const auto [low, high] = front_half.heights(prone.mesh.nodes());
  plates.lift = (low + high) / 2 - front_half.centroid_height();
  plates.thickness = share * (high - low);
}

/// 1 on the mesh, nothing from kGoesAlong_mm off it, and smooth.
double goes_along(double outside_mm) { return 1 - smooth_step(0, kGoesAlong_mm, outside_mm); }

/// Straight before the skin, and so in air, not beside a cut face.
bool before_skin(const MeshPoint& nearest) {
  const auto inner = [](double xi) { return xi > 0 && xi < 1; };
  return nearest.xi.z() == 1 && inner(nearest.xi.x()) && inner(nearest.xi.y());
}

/// How much of the way of its nearest point a point outside the mesh goes: all of it before the
/// skin, for air must not come to lie where the breast was.
double share_of_way(const CarriedPoint& found) {
  return before_skin(found.point) ? 1 : goes_along(found.outside_mm);
}

Volume<std::int16_t> image_of(const Volume<std::int16_t>& image, const HermiteMesh& prone,
                              const HermiteMesh& pressed) {
  const PointCarrier back(pressed, prone);
  Eigen::AlignedBox3d box = bounding_box(pressed);
  box.min().array() -= kGoesAlong_mm;
  box.max().array() += kGoesAlong_mm;
  Volume<std::int16_t> result = image;
  tbb::parallel_for(0, image.size.z(), [&](int k) {
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const Eigen::Vector3d x = image.position(i, j, k);
        if (!box.contains(x)) continue;
        const CarriedPoint found = back.carry(x);
        const Eigen::Vector3d moved = prone.position(found.point) - pressed.position(found.point);
        const Eigen::Vector3d from =
            found.outside_mm > 0 ? x + share_of_way(found) * moved : found.in_lps;
        result(i, j, k) = static_cast<std::int16_t>(
            std::lround(trilinear_corners(image, image.index(from)).of(image)));
      }
  });
  return result;
}

}  // namespace

CompressionResult press_between_coil_plates(CompressionProblem hanging,
                                            CompressionSettings settings, double share) {
  PlateOptions& plates = hanging.plates;
  settings.paddle_tilt_deg = 0;
  settings.shape_plates(plates);
  plates.up = Eigen::Vector3d::UnitX();
  plates.rounding = kRounding_mm;
  plates.wall_clearance = kClearance_mm;
  put_round_front_half(prone_file(hanging.mesh), 1 - share, plates);
  CompressionResult result = compress(hanging, settings.options);
  if (!result.report.usable())
    throw std::runtime_error("truth: between the coil's plates: " + result.report.reason);
  return result;
}

SyntheticPatient imaged_pressed(SyntheticPatient patient, const HermiteMesh& prone,
                                const HermiteMesh& pressed) {
  patient.scan.image = image_of(patient.scan.image, prone, pressed);
  const PointCarrier there(prone, pressed);
  for (Lesion& lesion : patient.truth.lesions)
    lesion.centroid_in_lps = there.carry(lesion.centroid_in_lps).in_lps;
  patient.truth.nipple_in_lps = there.carry(patient.truth.nipple_in_lps).in_lps;
  return patient;
}

}  // namespace mammotwin
