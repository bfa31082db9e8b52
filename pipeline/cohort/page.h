#pragma once

#include <string>
#include <vector>

#include "pipeline/cohort/patient_summary.h"
#include "pipeline/cohort/tables.h"

namespace mammotwin {

/// The cohort's page, one HTML file without scripts or network: counts, failures first, patients to
/// look at, the distribution of every figure with its outliers, all patients. Links are relative to
/// the results folder, where it stands.
std::string cohort_page(const std::vector<PatientSummary>& cohort, const RunAgain& again);

}  // namespace mammotwin
