#pragma once

#include <array>
#include <cstdint>

#include "pipeline/synthesize/coil.h"
#include "pipeline/synthesize/options.h"
#include "pipeline/synthesize/tissue_map.h"

namespace mammotwin {

/// Intensities by material, fat = 1. Source: simulator of the project's segmentation study, whose
/// fat-suppressed column was compared with two real patients; the lesion is set by an option.
std::array<double, num_substances> intensities(const ScanOptions& options);

/// Radius of the coil's loops [mm] that gave shading like that of real images (same study).
double coil_radius_mm(ScanContrast contrast);

struct Scan {
  Volume<std::int16_t> image;  ///< grey values; unshaded fat has `fat_grey`
  double shading_ratio = 1;    ///< 99th over 1st percentile of the shading in the body
};

/// Grey value of fat where the coil's sensitivity is 1: noise of 3 % is then a little over one
/// grey value, so that no digit is spent on noise and the file packs well.
inline constexpr double fat_grey = 40;

/// The image of a body: texture, mixing, vessels, blur, shading, Rician noise, rounding, in this
/// order. `failed_patch`: middle of the patch where fat is not suppressed [mm].
Scan scan(const TissueMap& tissue, const Coil& coil, const ScanOptions& options, std::uint64_t seed,
          const Eigen::Vector3d& failed_patch);

}  // namespace mammotwin
