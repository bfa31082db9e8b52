#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace mammotwin {

/// A row for each lesion and view of a registered tomosynthesis case: name, view, slice,
/// slice_true, slice_mm (how far apart they are), mark_mm (across the slice). Throws
/// std::runtime_error naming the file that is missing.
nlohmann::json tomosynthesis_rows(const std::filesystem::path& folder);

}  // namespace mammotwin
