#pragma once

#include <cstddef>
#include <functional>
#include <optional>

namespace mammotwin {

/// Calls attempt(0), attempt(1), ... attempt(count - 1) in a child process and returns the first
/// that ends it: by a signal, or after 60 s of processor time. Exceptions count as survived. For
/// libraries that stop the program over a damaged file (GDCM asserts, in Debian's build, too).
/// Empty if all survive, or where no process can be started.
std::optional<std::size_t> first_fatal(std::size_t count,
                                       const std::function<void(std::size_t)>& attempt);

}  // namespace mammotwin
