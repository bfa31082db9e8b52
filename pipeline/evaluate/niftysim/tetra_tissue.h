#pragma once

#include "pipeline/evaluate/niftysim/niftysim_file.h"
#include "segmentation/image/volume.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Fractions of fat and fibroglandular on a grid of 1 mm, from the tetrahedra of the model's first
/// two sets; the third, skin, counts as fat, because a membrane has its stiffness.
Volume<Fractions> tissue_of_tetrahedra(const NiftySimModel& model);

/// Volume of one set [mm^3].
double volume_of_set(const NiftySimModel& model, int set);

/// Corners of the faces that belong to one tetrahedron.
std::vector<std::array<int, 3>> outer_faces(const NiftySimModel& model);

}  // namespace mammotwin
