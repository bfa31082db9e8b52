#include "pipeline/cohort/stage_result.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <tuple>

#include "pipeline/frame/sidecar.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::array kChain{"segment", "fit", "unload", "compress", "register", "report"};

auto place_in_chain(const StageResult& result) {
  const auto at = std::find(kChain.begin(), kChain.end(), result.stage);
  return std::make_tuple(at - kChain.begin(), result.product);
}

std::map<std::string, std::string> checksums(const json& list) {
  std::map<std::string, std::string> sums;
  for (const json& file : list) sums[file.at("path")] = file.at("sha256");
  return sums;
}

void take_inputs(const json& list, StageResult& result) {
  for (const json& file : list)
    if (file.contains("path") && !file.at("path").get<std::string>().starts_with(".."))
      result.inputs[file.at("path")] = file.at("sha256");
    else
      result.sources[file.at("role")] = file.at("sha256");
}

StageResult result_from(const json& sidecar, const std::string& product) {
  StageResult result;
  result.product = product;
  result.stage = sidecar.at("stage");
  result.status = sidecar.at("status");
  result.reasons = sidecar.at("reasons").get<std::vector<std::string>>();
  result.quality = sidecar.at("quality");
  take_inputs(sidecar.at("inputs"), result);
  result.outputs = checksums(sidecar.at("outputs"));
  result.seconds = sidecar.at("seconds");
  result.peak_memory_mb = sidecar.at("peak_memory_mb");
  return result;
}

StageResult unreadable(const std::string& product, const std::string& why) {
  StageResult result;
  result.product = product;
  result.status = "refused";
  result.reasons = {product + ".json: " + why};
  return result;
}

/// Markups are JSON, too: a file without a stage counts only where it should be a sidecar.
bool is_another_file(const fs::path& file) {
  if (file.stem().extension() == ".mrk") return true;
  std::ifstream in(file);
  const json value = json::parse(in, nullptr, false);
  if (value.is_discarded()) return !fs::exists(file.parent_path() / file.stem());
  return !value.is_object() || !value.contains("stage");
}

std::optional<StageResult> read_stage_result(const fs::path& file) {
  if (is_another_file(file)) return std::nullopt;
  const std::string product = file.stem().string();
  const SidecarFile read = read_sidecar(file.parent_path() / product);
  return read.sidecar ? result_from(*read.sidecar, product) : unreadable(product, read.fault);
}

}  // namespace

std::vector<StageResult> read_stage_results(const fs::path& folder) {
  std::vector<StageResult> results;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".json" || file.filename().string().front() == '.') continue;
    if (auto result = read_stage_result(file)) results.push_back(std::move(*result));
  }
  std::sort(results.begin(), results.end(), [](const StageResult& a, const StageResult& b) {
    return place_in_chain(a) < place_in_chain(b);
  });
  return results;
}

}  // namespace mammotwin
