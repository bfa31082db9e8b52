#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pipeline/evaluate/segmentation/segmentation_cases.h"

namespace mammotwin {

/// Makes the case, segments its image (written to `image` on the way) with a point 2.6 mm off each
/// lesion's centroid, and scores it: one line of segmentation.json. A refused case keeps its
/// reason and has nulls. Fibroglandular tissue is scored 3 mm and more off the muscle in maps,
/// whose label lies on it by mistake in places. Where `keep` is not empty, the image, it
/// corrected, the true and the found labels are left there as
/// <name>_{mri,corrected,true,found}.nrrd.
nlohmann::json segmentation_row(const SegmentationCase& c, const std::filesystem::path& image,
                                const std::filesystem::path& keep = {});

/// Worst and median of each figure, a line a contrast; says which cases miss which aim.
std::string segmentation_summary(const nlohmann::json& cases);

}  // namespace mammotwin
