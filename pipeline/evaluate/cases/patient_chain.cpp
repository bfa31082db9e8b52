#include "pipeline/evaluate/cases/patient_chain.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/frame/outcome.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

std::string reason_in(const fs::path& sidecar, int exit_code) {
  std::ifstream in(sidecar);
  const nlohmann::json said = in ? nlohmann::json::parse(in) : nlohmann::json::object();
  const nlohmann::json reasons = said.value("reasons", nlohmann::json::array());
  return reasons.empty() ? "ended with code " + std::to_string(exit_code)
                         : reasons.front().get<std::string>();
}

}  // namespace

void run_patient_chain(const fs::path& toml, const fs::path& results) {
  const auto run = [&](const std::string& stage, std::vector<std::string> files,
                       const std::string& view = "") {
    const fs::path product = results / files.back();
    for (std::string& file : files) file = (results / file).string();
    if (!view.empty()) files.insert(files.begin(), view);
    files.insert(files.end(), {"--patient", toml.string()});
    const StageEnd end =
        run_stage_command(stage, files, results / (stage + view + ".log"), kMostStageCpuSeconds);
    if (end.exit_code == 0) return;
    const bool may_fail = !view.empty() && end.exit_code == exit_code(Status::not_converged);
    if (!may_fail)
      throw std::runtime_error(stage + view + ": " +
                               reason_in(product.string() + ".json", end.exit_code));
  };
  fs::create_directories(results);
  const std::string labels = "segmentation.seg.nrrd", fractions = "fractions.nrrd";
  run("segment", {labels});
  run("fit", {labels, fractions, "prone.vtu"});
  run("unload", {labels, fractions, "prone.vtu", "unloaded.vtu"});
  for (const std::string view : {"cc", "mlo"})
    run("compress", {labels, fractions, "unloaded.vtu", view + ".vtu"}, view);
  run("register", {labels, fractions, "cc.vtu", "mlo.vtu", "lesions.csv"});
}

}  // namespace mammotwin
