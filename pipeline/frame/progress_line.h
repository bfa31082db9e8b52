#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace mammotwin {

/// Says on stderr how far a stage is: one line that rewrites itself on a terminal, otherwise a
/// plain line at the start of each step and every ten seconds. Elapsed and remaining time are
/// stated; the remaining time assumes that the fraction grows evenly.
class ProgressLine {
 public:
  explicit ProgressLine(std::string stage);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// fraction in [0, 1] of the whole stage; `step` names what is being done.
  void report(double fraction, const std::string& step);
  void finish();

  std::function<void(double, const std::string&)> callback() {
    return [this](double fraction, const std::string& step) { report(fraction, step); };
  }

 private:
  double elapsed_seconds() const;

  std::string stage_;
  std::string step_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double last_line_at_ = -1;
  bool is_terminal_;
  bool line_open_ = false;
};

/// 75 -> "1:15".
std::string minutes_and_seconds(double seconds);

}  // namespace mammotwin
