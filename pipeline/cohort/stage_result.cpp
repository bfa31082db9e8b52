#include "pipeline/cohort/stage_result.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <tuple>

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

StageResult result_from(const json& sidecar, const std::string& product) {
  StageResult result;
  result.product = product;
  result.stage = sidecar.at("stage");
  result.status = sidecar.at("status");
  result.reasons = sidecar.at("reasons").get<std::vector<std::string>>();
  result.quality = sidecar.at("quality");
  result.inputs = checksums(sidecar.at("inputs"));
  result.outputs = checksums(sidecar.at("outputs"));
  result.seconds = sidecar.at("seconds");
  result.peak_memory_mb = sidecar.at("peak_memory_mb");
  return result;
}

StageResult unreadable(const std::string& product, const std::string& why) {
  StageResult result;
  result.product = product;
  result.status = "refused";
  result.reasons = {product + ".json: cannot be read as a sidecar (" + why +
                    "); run this patient again with FORCE=1"};
  return result;
}

std::optional<StageResult> read_stage_result(const fs::path& file) {
  const std::string product = file.stem().string();
  std::ifstream in(file);
  const json sidecar = json::parse(in, nullptr, false);
  const bool stands_beside_a_product = fs::exists(file.parent_path() / product);
  if (sidecar.is_discarded() && stands_beside_a_product) return unreadable(product, "not JSON");
  if (!sidecar.is_object() || !sidecar.contains("stage")) return std::nullopt;
  try {
    return result_from(sidecar, product);
  } catch (const json::exception& e) {
    return unreadable(product, e.what());
  }
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
