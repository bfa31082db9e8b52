#include "pipeline/synthesize/coil_pressed.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "registration/carry/point_carrier.h"
#include "registration/carry/position_grid.h"
#include "segmentation/image/trilinear.h"

namespace mammotwin {
namespace {

constexpr double kBeside_mm = 12;  // of the mesh: the nipple, skin that it smooths, air

/// What an image shows at a place where there is nothing, as noisy as there: its foremost row.
std::int16_t air(const Volume<std::int16_t>& image, int i, int k) { return image(i, 0, k); }

Volume<std::int16_t> image_of(const Volume<std::int16_t>& image, const HermiteMesh& prone,
                              const HermiteMesh& pressed) {
  const PointCarrier back(pressed, prone), there(prone, pressed);
  Eigen::AlignedBox3d box = bounding_box(prone).merged(bounding_box(pressed));
  box.min().array() -= kBeside_mm;
  box.max().array() += kBeside_mm;
  Volume<std::int16_t> result = image;
  tbb::parallel_for(0, image.size.z(), [&](int k) {
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const Eigen::Vector3d x = image.position(i, j, k);
        if (!box.contains(x)) continue;
        const CarriedPoint found = back.carry(x);
        if (found.outside_mm <= kBeside_mm)
          result(i, j, k) = static_cast<std::int16_t>(
              std::lround(trilinear_corners(image, image.index(found.in_lps)).of(image)));
        else if (there.carry(x).outside_mm <= kBeside_mm)
          result(i, j, k) = air(image, i, k);
      }
  });
  return result;
}

}  // namespace

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
