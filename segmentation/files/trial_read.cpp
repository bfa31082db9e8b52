#include "segmentation/files/trial_read.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

namespace mammotwin {
namespace {

constexpr rlim_t most_seconds = 60;

/// What child and parent both see.
struct Shared {
  std::atomic<std::size_t> current;
};

[[noreturn]] void run_child(std::size_t count, const std::function<void(std::size_t)>& attempt,
                            Shared& shared) {
  const rlimit no_core{0, 0}, processor{most_seconds, most_seconds};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &processor);
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(number, SIG_DFL);
  if (const int quiet = open("/dev/null", O_WRONLY); quiet >= 0) dup2(quiet, STDERR_FILENO);
  for (std::size_t n = 0; n < count; ++n) {
    shared.current = n;
    try {
      attempt(n);
    } catch (...) {  // the parent meets it again, and says it
    }
  }
  _exit(0);
}

}  // namespace

std::optional<std::size_t> first_fatal(std::size_t count,
                                       const std::function<void(std::size_t)>& attempt) {
  void* memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return std::nullopt;
  auto* shared = new (memory) Shared{};
  const pid_t child = fork();
  if (child == 0) run_child(count, attempt, *shared);
  int status = 0;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child;
  const std::size_t last = shared->current;
  munmap(memory, sizeof(Shared));
  const bool fatal = ended && (WIFSIGNALED(status) || WEXITSTATUS(status) != 0);
  return fatal ? std::optional(last) : std::nullopt;
}

}  // namespace mammotwin
