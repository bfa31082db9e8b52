#include "tests/pipeline/command.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace mammotwin {
namespace {

[[noreturn]] void become(const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment, int output) {
  dup2(output, 1);
  dup2(output, 2);
  dup2(open("/dev/null", O_RDONLY), 0);
  for (const std::string& entry : environment) putenv(const_cast<char*>(entry.c_str()));
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  _exit(127);
}

CommandResult run(const std::vector<std::string>& arguments,
                  const std::vector<std::string>& environment, bool in_group) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) {
    if (in_group) setpgid(0, 0);
    become(arguments, environment, ends[1]);
  }
  close(ends[1]);
  CommandResult result{};
  std::array<char, 4096> buffer{};
  for (ssize_t n; (n = read(ends[0], buffer.data(), buffer.size())) > 0;)
    result.text.append(buffer.data(), static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace

CommandResult run_command(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment) {
  return run(arguments, environment, false);
}

CommandResult run_command_in_group(const std::vector<std::string>& arguments,
                                   const std::vector<std::string>& environment) {
  return run(arguments, environment, true);
}

bool run_and_kill_after(double seconds, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& environment) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // orphans of what is killed come to this process
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) {
    setpgid(0, 0);
    become(arguments, environment, open("/dev/null", O_WRONLY));
  }
  setpgid(child, child);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  const bool running = waitpid(child, nullptr, WNOHANG) == 0;
  kill(-child, SIGKILL);
  while (waitpid(-child, nullptr, 0) > 0) {
  }
  return running;
}

}  // namespace mammotwin
