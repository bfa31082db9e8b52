#pragma once

#include <cstdlib>

namespace mammotwin {

/// How often a test kills what it runs: MAMMOTWIN_KILLS, by default few enough to keep it short.
inline int num_kills() {
  const char* asked = std::getenv("MAMMOTWIN_KILLS");
  return asked ? std::atoi(asked) : 20;
}

}  // namespace mammotwin
