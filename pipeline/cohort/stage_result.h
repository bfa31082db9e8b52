#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// What one sidecar (`<product>.json`, see frame/sidecar.h) says.
struct StageResult {
  std::string product;  ///< file name: "prone.vtu"
  std::string stage;
  std::string status;  ///< "ok", "look", "refused", "not_converged"
  std::vector<std::string> reasons;
  nlohmann::json quality;
  std::map<std::string, std::string> inputs;   ///< of the same folder: path -> sha256
  std::map<std::string, std::string> sources;  ///< of elsewhere, the patient's: role -> sha256
  std::map<std::string, std::string> outputs;  ///< file name -> sha256
  double seconds = 0;
  double peak_memory_mb = 0;

  bool usable() const { return status == "ok" || status == "look"; }
  /// "prone" for prone.vtu: what its columns begin with.
  std::string short_name() const { return product.substr(0, product.find('.')); }
};

/// All sidecars of a patient's results folder in the chain's order, a stage's own by product name.
/// Other JSON files are passed over; a sidecar that cannot be read counts as refused, and says so.
std::vector<StageResult> read_stage_results(const std::filesystem::path& folder);

}  // namespace mammotwin
