#include "pipeline/evaluate/cases/stage_command.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Between fork and exec of a program with threads: calls to the system only.
[[noreturn]] void become(char* const* argv, int output, int most_cpu_seconds) {
  const rlimit limit{static_cast<rlim_t>(most_cpu_seconds), static_cast<rlim_t>(most_cpu_seconds)};
  setrlimit(RLIMIT_CPU, &limit);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(argv[0], argv);
  _exit(127);  // as a shell says that a program was not found
}

/// One at a time: before each fork ITK joins the threads of its pool, and two that fork at once
/// would join them twice, which ends the program.
pid_t fork_alone() {
  static std::mutex forking;
  const std::lock_guard<std::mutex> alone(forking);
  return fork();
}

double seconds_of(const timeval& time) { return time.tv_sec + 1e-6 * time.tv_usec; }

}  // namespace

StageEnd run_program(const fs::path& program, const std::vector<std::string>& arguments,
                     const fs::path& log, int most_cpu_seconds) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::vector<char*> argv = pointers_to(words);
  const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (output < 0) throw std::runtime_error(log.string() + ": cannot be written");
  const pid_t child = fork_alone();
  if (child == 0) become(argv.data(), output, most_cpu_seconds);
  close(output);
  if (child < 0) throw std::runtime_error("no process could be made for " + words.front());
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) throw std::runtime_error("lost the process of " + words.front());
  StageEnd end;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  end.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  return end;
}

StageEnd run_stage_command(const std::string& stage, const std::vector<std::string>& arguments,
                           const fs::path& log, int most_cpu_seconds) {
  const fs::path beside = fs::read_symlink("/proc/self/exe").parent_path();
  return run_program(beside / ("mammotwin-" + stage), arguments, log, most_cpu_seconds);
}

json stage_sidecar(const fs::path& product) {
  std::ifstream in(product.string() + ".json");
  return in ? json::parse(in) : json();
}

double run_to_product(const ProductRun& run) {
  std::vector<std::string> arguments = run.inputs;
  arguments.push_back(run.product.string());
  if (!run.patient_toml.empty())
    arguments.insert(arguments.end(), {"--patient", run.patient_toml.string()});
  arguments.insert(arguments.end(), run.options.begin(), run.options.end());
  const fs::path log = fs::path(run.product).replace_extension(".log");
  const StageEnd end = run_stage_command(run.stage, arguments, log, run.most_cpu_seconds);
  if (end.exit_code == 0) return end.cpu_seconds;
  const json sidecar = stage_sidecar(run.product);
  const json reasons = sidecar.is_object() ? sidecar.value("reasons", json()) : json();
  throw std::runtime_error(run.stage + ": " +
                           (reasons.empty() ? "ended with code " + std::to_string(end.exit_code)
                                            : reasons.front().get<std::string>()));
}

}  // namespace mammotwin
