#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pipeline/synthesize/patient.h"

namespace mammotwin {

/// Points 4 mm off each lesion's true centroid, in seeded directions: what a person would click.
std::vector<Eigen::Vector3d> clicked_points(const SyntheticPatient& patient);

/// Text of the `patient.toml` that sends the patient through the pipeline.
std::string patient_toml(const SyntheticPatient& patient);

/// All that is true of the patient, with the options that made it; lengths mm, volumes ml.
nlohmann::json truth_json(const SyntheticPatient& patient);

}  // namespace mammotwin
