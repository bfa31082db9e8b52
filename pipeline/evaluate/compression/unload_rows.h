#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mammotwin {

/// How a fitted breast (segmentation.seg.nrrd, fractions.nrrd and prone.vtu in `folder`, imaged
/// prone) is unloaded with default settings, with half of all moduli, and with c1 = 0.1 kPa in
/// every tissue; how far it slides standing with three chest-wall springs. `seconds` are of the
/// processor.
nlohmann::json unload_rows(const std::filesystem::path& folder);

/// Where points of the breast come to lie in CC (0 deg) and MLO (45 deg) with and without
/// unloading, in the view's frame: `lesions` and `points` (middles of elements) hold the median and
/// the largest difference in the image plane [mm]. Thickness as the plates' default of the prone
/// breast.
nlohmann::json view_shifts(const std::filesystem::path& folder);

}  // namespace mammotwin
