#pragma once

#include <filesystem>

namespace mammotwin {

/// From now on what is told to stop (Ctrl-C, SIGTERM, SIGHUP) removes what ends with it before it
/// ends. Call before other threads are there: they inherit that these signals wait.
void stop_without_leftovers();

/// Removes what ends with the run, before the process ends without unwinding; the next run removes
/// it where a thread of this one is busy with it.
void remove_leftovers();

/// A temporary file or folder that must not outlive a stop. It is left alone when this goes out of
/// scope.
class EndsWithTheRun {
 public:
  explicit EndsWithTheRun(std::filesystem::path path);
  ~EndsWithTheRun();
  EndsWithTheRun(const EndsWithTheRun&) = delete;
  EndsWithTheRun& operator=(const EndsWithTheRun&) = delete;

 private:
  std::filesystem::path path_;
};

}  // namespace mammotwin
