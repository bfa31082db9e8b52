#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "segmentation/label_maps/label_values.h"

namespace mammotwin {

/// What the segments of a 3D Slicer .seg.nrrd are. Slicer numbers segments anew when it saves, so
/// that names and terminology are asked, and the value only where neither is known.
struct NamedSegments {
  LabelValues values;                            ///< empty: the file names no segments
  std::map<std::uint16_t, std::string> lesions;  ///< names of those that are lesions, by value
};

/// Recognised, in any case: skin; fat, adipose; fibroglandular, gland; muscle, pectoral, chest
/// wall; lesion, tumour, tumor, mass, cancer; SNOMED codes of the segment's terminology. A segment
/// of none of these keeps its value's own meaning (segmentation.h); std::runtime_error, naming it,
/// where that has none, or where a segment lies in a second layer.
NamedSegments read_segment_names(const std::filesystem::path& path);

}  // namespace mammotwin
