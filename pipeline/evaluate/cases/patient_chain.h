#pragma once

#include <filesystem>

namespace mammotwin {

/// Runs the stages from segment to register of the patient that `toml` describes, each in a process
/// of its own; products and logs go to `results`. Throws std::runtime_error with the stage and its
/// reason where one ends badly; a view that is not reached is left out, as `register` leaves it
/// out.
void run_patient_chain(const std::filesystem::path& toml, const std::filesystem::path& results);

}  // namespace mammotwin
