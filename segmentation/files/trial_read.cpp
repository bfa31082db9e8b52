#include "segmentation/files/trial_read.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// Empty where it is not there.
fs::path trial_program() {
  std::error_code none;
  const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* place : {"mammotwin-try-read", "../libexec/mammotwin/mammotwin-try-read"})
    if (const fs::path program = folder / place; fs::exists(program, none)) return program;
  return {};
}

/// Closes a file when it is left; -1: none.
struct Descriptor {
  int number = -1;
  explicit Descriptor(int n = -1) : number(n) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (number >= 0) ::close(number);
    number = -1;
  }
};

/// The names, each ended by a zero byte, in a file in memory: a child that ends early is no broken
/// pipe.
bool write_names(const std::vector<fs::path>& files, int to) {
  std::string names;
  for (const fs::path& file : files) names.append(file.string()).push_back('\0');
  for (std::size_t done = 0; done < names.size();) {
    const ssize_t n = write(to, names.data() + done, names.size() - done);
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return lseek(to, 0, SEEK_SET) == 0;
}

/// Process started, or -1.
pid_t start(const fs::path& program, Trial trial, int input, int output) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string name = program.string(), what = trial == Trial::dicom ? "dicom" : "raw_header";
  char* arguments[] = {name.data(), what.data(), nullptr};
  pid_t child = -1;
  if (posix_spawn(&child, name.c_str(), &actions, nullptr, arguments, environ) != 0) child = -1;
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

enum class Heard { byte, end, nothing };

Heard listen(int output, std::chrono::steady_clock::time_point until) {
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0) return Heard::nothing;
    pollfd waiting{output, POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno != EINTR) return Heard::nothing;
    if (ready <= 0) continue;
    char byte = 0;
    const ssize_t n = read(output, &byte, 1);
    if (n == 1) return Heard::byte;
    if (n == 0) return Heard::end;
  }
}

}  // namespace

std::optional<FailedTrial> first_fatal(Trial trial, const std::vector<fs::path>& files,
                                       std::chrono::milliseconds limit) {
  const fs::path program = trial_program();
  const Descriptor names(memfd_create("names", MFD_CLOEXEC));
  int ends[2] = {-1, -1};
  if (program.empty() || names.number < 0 || !write_names(files, names.number) ||
      pipe2(ends, O_CLOEXEC) != 0)
    return std::nullopt;
  const Descriptor output(ends[0]);
  Descriptor childs(ends[1]);
  const pid_t child = start(program, trial, names.number, childs.number);
  childs.close();
  if (child < 0) return std::nullopt;

  std::size_t begun = 0;  // the child says a byte before each file, and ends
  Heard heard = Heard::byte;
  while ((heard = listen(output.number, std::chrono::steady_clock::now() + limit)) == Heard::byte)
    ++begun;
  if (heard == Heard::nothing) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (begun == 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0)) return std::nullopt;
  return FailedTrial{begun - 1, heard == Heard::nothing};
}

}  // namespace mammotwin
