#include "pipeline/frame/process.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include "pipeline/frame/memory_watch.h"
#include "pipeline/frame/private_names.h"
#include "pipeline/frame/products.h"
#include "solver/newton/blas_kernels.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr char kPrepared[] = "MAMMOTWIN_PREPARED";
constexpr char kEndsWithParent[] = "MAMMOTWIN_ENDS_WITH_ITS_PARENT";

bool names_a_path(std::string_view argument) {
  return argument.find('/') != std::string_view::npos && argument.front() != '-';
}

std::string said_path(const std::string& argument, const fs::path& folder,
                      const PrivateNames* names) {
  const fs::path base = whole_path(folder);
  const std::string relative = whole_path(argument).lexically_relative(base).string();
  if (!names || !relative.starts_with("..")) return relative;
  const std::string role = names->role_of(argument);
  return role.empty() ? "file" : role;
}

}  // namespace

void prepare_process(char** argv) {
  if (std::getenv(kEndsWithParent)) prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (std::getenv(kPrepared)) return;
  setenv(kPrepared, "1", 1);
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  const std::string core = blas_core_type();
  if (!core.empty()) setenv("OPENBLAS_CORETYPE", core.c_str(), 0);
  execv("/proc/self/exe", argv);  // returns only on failure: then go on with slower kernels
}

namespace {

[[noreturn]] void say_that_memory_lacks() {
  constexpr std::string_view said =
      "refused: there is not enough memory to begin with (is it limited, by ulimit -v or the batch "
      "system?)\n";
  if (write(STDERR_FILENO, said.data(), said.size()) < 0) _exit(1);
  _exit(1);
}

/// Before libraries begin, and before libc has the environment: OpenBLAS starts its threads as it
/// is loaded, and ends the program by a signal where there is no memory for them; others let
/// std::bad_alloc go.
void prepare_before_libraries(int, char** argv, char** environment) {
  environ = environment;
  prepare_process(argv);
  if (address_space_is_limited()) std::set_terminate(say_that_memory_lacks);
}

__attribute__((section(".preinit_array"),
               used)) void (*const first)(int, char**, char**) = prepare_before_libraries;

}  // namespace

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;  // ru_maxrss is in KiB on Linux
}

std::string command_text(int argc, char** argv, const fs::path& folder, const PrivateNames* names) {
  std::string text = fs::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i)
    text += " " + (names_a_path(argv[i]) ? said_path(argv[i], folder, names) : argv[i]);
  return text;
}

}  // namespace mammotwin
