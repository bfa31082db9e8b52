#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace mammotwin {

/// What is wrong with what should be a sidecar, with field, expected and found: a field missing, of
/// another type or out of range. Empty where nothing is.
std::string schema_fault(const nlohmann::json& sidecar);

/// With the checksum of all its other fields, so that an edited one is noticed: against mistakes,
/// not against who computes it anew.
nlohmann::json sealed(nlohmann::json sidecar);

/// Is every field as it was when the sidecar was sealed?
bool seal_holds(const nlohmann::json& sidecar);

}  // namespace mammotwin
