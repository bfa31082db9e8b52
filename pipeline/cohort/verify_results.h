#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mammotwin {

struct Verification {
  int files_checked = 0;
  std::vector<std::string> differences;  ///< sentences; empty if all is as the sidecars say
};

/// Recomputes the checksum of every input and output that the sidecars of a patient's results
/// folder speak of. `data`: the patient's folder, in which inputs of elsewhere, whose names results
/// do not keep, are found by their checksums; where it is empty they are not checked. Throws
/// std::runtime_error if the folder holds no sidecar.
Verification verify_results(const std::filesystem::path& folder, const std::filesystem::path& data);

}  // namespace mammotwin
