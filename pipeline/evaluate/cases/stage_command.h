#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// A segmentation or fit takes some 30.
inline constexpr int kMostStageCpuSeconds = 3600;

struct StageEnd {
  int exit_code = 0;       ///< 128 + number where a signal ended it, as a shell says it
  double cpu_seconds = 0;  ///< all its threads, user and system
};

/// Runs a program in a process of its own; what it says goes to the file `log`. It is ended after
/// `most_cpu_seconds`. Throws std::runtime_error where no process can be made.
StageEnd run_program(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, const std::filesystem::path& log,
                     int most_cpu_seconds);

/// The same for a command of this build, `mammotwin-<stage>` beside the running program.
StageEnd run_stage_command(const std::string& stage, const std::vector<std::string>& arguments,
                           const std::filesystem::path& log, int most_cpu_seconds);

/// The sidecar of a stage's product; null where there is none.
nlohmann::json stage_sidecar(const std::filesystem::path& product);

/// A stage that makes one main product.
struct ProductRun {
  std::string stage;
  std::vector<std::string> inputs;
  std::filesystem::path product;       ///< the log goes beside it
  std::filesystem::path patient_toml;  ///< empty: the stage's defaults
  std::vector<std::string> options = {};
  int most_cpu_seconds = kMostStageCpuSeconds;
};

/// CPU seconds. Throws std::runtime_error with the stage's reason where it left no product.
double run_to_product(const ProductRun& run);

}  // namespace mammotwin
