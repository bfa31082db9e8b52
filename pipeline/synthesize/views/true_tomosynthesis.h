#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "pipeline/synthesize/views/true_views.h"
#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {

/// Slices of a tomosynthesis scan, dense tissue bright; the first lies at the support.
struct TomosynthesisVolume {
  TomosynthesisSlices stack;
  double pixel_mm = 0;
  std::vector<DetectorImage> slices;  ///< (u, v) of the breast's plane, from the edge
};

/// A scan of the compressed breast: the tube goes through 15 degrees about the support's edge, the
/// view's lateral axis, in 15 steps, quanta of each projection counted; the projections shifted and
/// added, slices of 1 mm. `marker_in_view`: a metal ball of 3.5 mm on the nipple.
TomosynthesisVolume tomosynthesis_volume(const HermiteMesh& prone, const HermiteMesh& compressed,
                                         const Volume<Fractions>* fractions,
                                         const CompressedView& view,
                                         const std::optional<Eigen::Vector3d>& marker_in_view,
                                         std::uint64_t seed);

/// That of a synthetic patient's view, with a marker.
TomosynthesisVolume true_tomosynthesis(const TrueBreast& breast, const TrueView& view,
                                       std::uint64_t seed);

/// Slices' pixels as they hang, seen from infinitely far.
Detector detector_of(const TomosynthesisVolume& volume, Side side);

/// Writes it as a Breast Tomosynthesis Image (PS3.3 A.55) of 12 bits: functional groups with pixel
/// measures, anatomy, orientation and each frame's position; acquisition with distances, thickness
/// and angle. `angle_deg`, `thickness_mm`: what the header says. Throws std::runtime_error naming
/// the file that cannot be written.
void write_tomosynthesis(const std::filesystem::path& path, const TomosynthesisVolume& volume,
                         const CompressedView& view, double angle_deg, double thickness_mm);

}  // namespace mammotwin
