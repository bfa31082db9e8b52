#pragma once

#include "solver/contact/plate_placement.h"

namespace mammotwin {

/// Thickness [mm] of women's breasts in CC with so much [ml] between the plates: 30 to 90 mm, the
/// means of a model of compressed breasts (Pinto et al., Med. Phys. 2022, 10.1002/mp.16133).
double typical_thickness_mm(double volume_ml);

/// What is assumed of a breast whose compressed thickness nobody says [mm]: what is typical of that
/// much tissue in front of the plates' edge, within reason of its extent between them.
double assumed_thickness_mm(const MeshFile& imaged, const PlateOptions& plates);

}  // namespace mammotwin
