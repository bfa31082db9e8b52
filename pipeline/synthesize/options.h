#pragma once

#include <cstdint>
#include <string>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// What a synthetic patient is made of. Sizes are of the breast of `side`; the seed decides what
/// no option names (outline, gland, places of the lesions, texture, noise). Ranges, units and
/// meanings stand in option_table.h.
struct AnatomyOptions {
  std::uint64_t seed = 42;
  Side side = Side::left;
  double volume_ml = 650;
  double projection = 1.6;
  double ptosis = 0.35;
  double asymmetry = 0.12;
  double chest_half_width_mm = 140;
  double chest_roundness = 0.68;
  double density = 0.15;
  double skin_mm = 1.8;
  double subcutaneous_mm = 12;
  double pectoral_mm = 14;
  int lesions = 2;
  double lesion_min_mm = 10;
  double lesion_max_mm = 16;
};

enum class ScanContrast {
  fat_suppressed,  ///< T1, fat suppressed, after contrast agent
  not_suppressed   ///< T1, before contrast agent
};

/// How the patient is imaged. Each fault can be switched off by its zero.
struct ScanOptions {
  ScanContrast contrast = ScanContrast::fat_suppressed;
  double voxel_mm = 1.2;
  int samples = 3;
  double blur_voxels = 0.55;
  double shading = 1.3;
  double noise = 0.035;
  double texture = 1;
  double lesion_to_gland = 1.78;
  double muscle_to_fat = 0;   ///< 0: what is usual for the contrast
  double organs_to_fat = 0;   ///< heart and liver; 0: what is usual for the contrast
  double vessels_to_fat = 0;  ///< blood with agent in the breast; 0: no vessels
  double ghosts = 0;          ///< of movement: copies of the body beside it, over its intensity
  bool failed_suppression = false;
  bool contrast_agent = false;  ///< not suppressed: the image after it, of the same body
};

/// What the plates are asked for in `patient.toml`.
struct ViewOptions {
  double compressed_fraction = 0.55;
  double mlo_angle_deg = 45;
};

struct PatientOptions {
  AnatomyOptions anatomy;
  ScanOptions scan;
  ViewOptions views;
};

/// Throws std::invalid_argument that names the first option out of range, what was found and
/// what is expected.
void check(const PatientOptions& options);

std::string name_of(Side side);              ///< "left", "right"
std::string name_of(ScanContrast contrast);  ///< "fat_suppressed", "not_suppressed"

}  // namespace mammotwin
