#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/evaluate/compression/outline_population.h"

namespace mammotwin {

/// A breast's CC view at the thickness to which radiographers press its volume in front of the
/// plates' edge, begun with that of `view`, pressed to whatever thickness: `folder`/cc.vtu, by
/// mammotwin-compress from segmentation.seg.nrrd, fractions.nrrd, unloaded.vtu or prone.vtu, and
/// patient.toml (if it is there) in `from`. Throws
/// std::runtime_error where no such view comes out.
std::filesystem::path press_typically(const std::filesystem::path& view,
                                      const std::filesystem::path& from,
                                      const OutlinePopulation& population,
                                      const std::filesystem::path& folder);

/// Adds what the sidecar says of a pressed view to the row: `press_status`, `force_N` (the
/// paddle's), `pressure_kpa` (its mean over the contact), `retained_fraction` (in front of the
/// plates' edges, of what lay there as imaged); null where there is no sidecar.
void add_press(const std::filesystem::path& view, nlohmann::json& row);

/// Presses an unloaded breast's `folder` (segmentation.seg.nrrd, fractions.nrrd, unloaded.vtu,
/// patient.toml) in CC to the thickness that is typical of its volume and adds to the row:
/// what `add_press` adds, `thickness_mm`, `width_ratio` and `depth_ratio` (to the population's at
/// that thickness). What fails leaves its figures null and says why in `reason` where nothing
/// failed before.
void add_plates(const std::filesystem::path& folder, const OutlinePopulation& population,
                nlohmann::json& row);

}  // namespace mammotwin
