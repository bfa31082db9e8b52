#pragma once

#include <filesystem>

#include "pipeline/evaluate/compression/outline_population.h"

namespace mammotwin {

/// A breast's CC view at the thickness to which radiographers press its volume in front of the
/// plates' edge, as `view`, pressed to whatever thickness, has it: `folder`/cc.vtu, by
/// mammotwin-compress from segmentation.seg.nrrd, fractions.nrrd, unloaded.vtu or prone.vtu, and
/// patient.toml (if it is there) in `from`. What lies there already and is current is kept. Throws
/// std::runtime_error where no such view comes out.
std::filesystem::path press_typically(const std::filesystem::path& view,
                                      const std::filesystem::path& from,
                                      const OutlinePopulation& population,
                                      const std::filesystem::path& folder);

}  // namespace mammotwin
