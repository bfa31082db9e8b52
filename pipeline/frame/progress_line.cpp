#include "pipeline/frame/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mammotwin {
namespace {
constexpr double kPlainLineEverySeconds = 10;
constexpr double kTerminalLineEverySeconds = 0.1;
}  // namespace

std::string minutes_and_seconds(double seconds) {
  const long total = std::lround(std::max(0.0, seconds));
  char text[32];
  std::snprintf(text, sizeof text, "%ld:%02ld", total / 60, total % 60);
  return text;
}

ProgressLine::ProgressLine(std::string stage)
    : stage_(std::move(stage)), is_terminal_(isatty(2) == 1) {}

ProgressLine::~ProgressLine() { finish(); }

double ProgressLine::elapsed_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressLine::report(double fraction, const std::string& step) {
  const double now = elapsed_seconds();
  const bool new_step = step != step_;
  const double every = is_terminal_ ? kTerminalLineEverySeconds : kPlainLineEverySeconds;
  if (!new_step && now - last_line_at_ < every) return;
  step_ = step;
  last_line_at_ = now;
  std::string line = stage_ + ": " +
                     std::to_string(std::lround(100 * std::clamp(fraction, 0., 1.))) + " %, " +
                     minutes_and_seconds(now) + " elapsed";
  if (fraction > 0.05 && fraction < 1)
    line += ", about " + minutes_and_seconds(now * (1 - fraction) / fraction) + " left";
  line += ": " + step;
  if (is_terminal_)
    std::fprintf(stderr, "\r\033[K%s", line.c_str());
  else
    std::fprintf(stderr, "%s\n", line.c_str());
  std::fflush(stderr);
  line_open_ = is_terminal_;
}

void ProgressLine::finish() {
  if (line_open_) std::fprintf(stderr, "\r\033[K");
  line_open_ = false;
}

}  // namespace mammotwin
