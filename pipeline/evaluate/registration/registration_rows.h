#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mammotwin {

/// How far a registered synthetic patient's marks are from the truth in its landmarks.csv: medians
/// over lesions and points after the search (`tre_*`), before it and for the baseline; all errors
/// under `errors`; coverage of `lesions` and `points` (`coverage_of`), whose `marks` follow. Throws
/// std::runtime_error with register's reason where it refused.
nlohmann::json registration_row(const std::filesystem::path& folder);

/// A row's keys without values, for a patient that failed.
nlohmann::json empty_registration_row();

/// Over all cases' landmarks: median, mean and 95th percentile of each error, and the coverage.
std::string registration_summary(const nlohmann::json& cases);

}  // namespace mammotwin
