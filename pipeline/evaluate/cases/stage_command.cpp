#include "pipeline/evaluate/cases/stage_command.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

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

double seconds_of(const timeval& time) { return time.tv_sec + 1e-6 * time.tv_usec; }

}  // namespace

StageEnd run_stage_command(const std::string& stage, const std::vector<std::string>& arguments,
                           const fs::path& log, int most_cpu_seconds) {
  std::vector<std::string> words{
      (fs::read_symlink("/proc/self/exe").parent_path() / ("mammotwin-" + stage)).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::vector<char*> argv = pointers_to(words);
  const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (output < 0) throw std::runtime_error(log.string() + ": cannot be written");
  const pid_t child = fork();
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

}  // namespace mammotwin
