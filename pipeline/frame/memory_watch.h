#pragma once

#include <functional>

namespace mammotwin {

/// By `ulimit -v` or a batch system.
bool address_space_is_limited();

/// For the end of a run that lacked memory: what libraries did not get, they fault over when they
/// are taken down (ITK).
[[noreturn]] void leave_without_destructors(int exit_code);

/// While it lives, a failed allocation ends the process with exit code 1, after `last` has said and
/// written why: libraries go on without the memory that they asked for and end the program
/// elsewhere (ITK, VTK), or put lack of memory into words of their own. `last` has memory that was
/// kept for it; other threads that run out, or fault for it, wait. Where address space is limited,
/// std::terminate counts as such a failure (ITK's threads that cannot be started).
class EndsWithoutMemory {
 public:
  explicit EndsWithoutMemory(std::function<void()> last);
  ~EndsWithoutMemory();
  EndsWithoutMemory(const EndsWithoutMemory&) = delete;
  EndsWithoutMemory& operator=(const EndsWithoutMemory&) = delete;
};

}  // namespace mammotwin
