#pragma once

#include <filesystem>

#include "pipeline/cohort/tables.h"

namespace mammotwin {

/// The rows of every patient's lesions.csv, as they stand there; patients in the order of `cohort`.
/// A file whose columns are not those of the files before it is left out and named in `left_out`.
Table lesions_table(const std::filesystem::path& results, const std::vector<PatientSummary>& cohort,
                    std::vector<std::string>& left_out);

}  // namespace mammotwin
