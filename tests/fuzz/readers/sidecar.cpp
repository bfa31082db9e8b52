#include "pipeline/frame/sidecar.h"

#include <nlohmann/json.hpp>

#include "pipeline/cohort/stage_result.h"
#include "pipeline/frame/sidecar_check.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

/// As it is, and sealed anew where it is an object, so that what lies behind the seal is read, too.
void sidecar(const std::string& bytes) {
  const auto product = fuzzed_file("a.vtu", "").replace_filename("a.vtu");
  const auto file = fuzzed_file("a.vtu.json", bytes);
  const SidecarFile as_it_is = read_sidecar(product);
  read_stage_results(file.parent_path());
  const auto value = nlohmann::json::parse(bytes, nullptr, false);
  if (as_it_is.fault.find("edited") == std::string::npos) return;
  fuzzed_file("a.vtu.json", sealed(value).dump());
  read_sidecar(product);
  former_outputs(product);
  standing_failure(product, {});
  read_stage_results(file.parent_path());
}

}  // namespace mammotwin::fuzz
