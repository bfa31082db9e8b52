#pragma once

#include <nlohmann/json_fwd.hpp>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/compression/outline_population.h"

namespace mammotwin {

/// How a compressed breast's outline compares with the population's at its thickness, in 51
/// directions 3 degrees apart from the middle of its own outline on the plates' edge: `compared`
/// (directions in which the model has skin there), `within_2_sd` (their fraction), `mean_sd` and
/// `worst_sd` (ours minus theirs, over their standard deviation), `depth_mm` and `width_mm` beside
/// `population_depth_mm` and `population_width_mm`, and over them `depth_ratio` and `width_ratio`,
/// volumes in front of the edge `volume_ml` and `population_volume_ml`. These are null where the
/// population has no such thickness. `typical_thickness_mm` is to what a real breast of this volume
/// is pressed, within 30 to 90 mm. `medial_deeper`: skin at a quarter of the outline's width from
/// its medial end lies so much deeper than at a quarter from its lateral end, over the depth half
/// way.
nlohmann::json outline_row(const MeshFile& compressed, const OutlinePopulation& population);

}  // namespace mammotwin
