#pragma once

#include <vector>

#include "solver/contact/contact_figures.h"
#include "solver/contact/plate.h"

namespace mammotwin {

/// The gap of a point of the skin, for the deformed area that it stands for.
struct WeighedGap {
  double gap = 0;   ///< [mm], negative inside the plate
  double area = 0;  ///< [mm²]
};

/// Gaps where the flat face of a plate presses: at the points of the skin that look at it from 15
/// mm and less (what is farther off is behind a fold) and lie, seen along its normal, within the
/// alpha shape of those that touch it (Edelsbrunner, Kirkpatrick, Seidel, 1983): no circle of 15 mm
/// radius holds them and none that touches. So a pocket between ridges counts, and skin that leaves
/// the plate at the border of what it presses does not. A skin that lies flat has none.
std::vector<WeighedGap> pressed_gaps(const Model& model, const State& state, const Plate& plate,
                                     const FaceList& faces, int points1d);

/// The gap that `share` of the area stays under [mm]; 0 without any area.
double gap_percentile(std::vector<WeighedGap> gaps, double share);

}  // namespace mammotwin
