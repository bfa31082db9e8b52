#pragma once

#include "pipeline/synthesize/options.h"

namespace mammotwin {

/// Calls visit(name, variable, low, high, unit, help) for every numeric option of a synthetic
/// patient: the one place where their ranges stand.
template <class Options, class Visit>
void visit_numbers(Options& o, const Visit& visit) {
  auto& a = o.anatomy;
  visit("volume_ml", a.volume_ml, 150, 1500, "ml", "breast: skin to pectoral muscle in its region");
  visit("projection", a.projection, 0.8, 2, "-", "length from the chest wall over mean half width");
  visit("ptosis", a.ptosis, 0, 1, "-", "how far the breast's tip hangs towards the feet");
  visit("asymmetry", a.asymmetry, -0.3, 0.3, "-", "the other breast is this fraction larger");
  visit("chest_half_width_mm", a.chest_half_width_mm, 115, 170, "mm", "rib cage, middle to side");
  visit("chest_roundness", a.chest_roundness, 0.55, 0.85, "-",
        "depth of the rib cage over its width");
  visit("density", a.density, 0.005, 0.6, "-", "fibroglandular over breast volume");
  visit("skin_mm", a.skin_mm, 1, 3, "mm", "thickness of the skin");
  visit("subcutaneous_mm", a.subcutaneous_mm, 8, 25, "mm", "fat under the skin beside the breasts");
  visit("pectoral_mm", a.pectoral_mm, 10, 25, "mm", "pectoral muscle where it is thickest");
  visit("lesions", a.lesions, 1, 3, "-", "number of lesions");
  visit("lesion_min_mm", a.lesion_min_mm, 8, 20, "mm", "smallest lesion: ball of the same volume");
  visit("lesion_max_mm", a.lesion_max_mm, 8, 20, "mm", "largest lesion: ball of the same volume");
  auto& s = o.scan;
  visit("voxel_mm", s.voxel_mm, 0.7, 5, "mm", "edge of the cubic voxels");
  visit("samples", s.samples, 2, 6, "-", "points a voxel and axis that make its fractions");
  visit("blur_voxels", s.blur_voxels, 0, 2, "voxels", "sigma of the Gaussian point spread");
  visit("shading", s.shading, 0, 2, "-", "exponent on the coil's sensitivity");
  visit("noise", s.noise, 0, 0.15, "-", "Rician sigma over the intensity of fat");
  visit("texture", s.texture, 0, 2, "-", "septa in fat and mottle in gland over the usual");
  visit("lesion_to_gland", s.lesion_to_gland, 0.8, 4, "-",
        "intensity of lesion over gland, suppressed");
  visit("muscle_to_fat", s.muscle_to_fat, 0, 4, "-", "intensity of muscle over fat; 0: usual");
  visit("organs_to_fat", s.organs_to_fat, 0, 4, "-", "of heart and liver over fat; 0: usual");
  visit("vessels_to_fat", s.vessels_to_fat, 0, 10, "-", "of vessels over fat; 0: none");
  visit("ghosts", s.ghosts, 0, 0.3, "-", "copies of the body beside it, over its intensity");
  auto& v = o.views;
  visit("compressed_fraction", v.compressed_fraction, 0.2, 0.8, "-",
        "1 - thickness over free extent");
  visit("mlo_angle_deg", v.mlo_angle_deg, 30, 60, "degrees", "positioner angle of the MLO view");
}

}  // namespace mammotwin
