#include "pipeline/frame/stop_signals.h"

#include <algorithm>
#include <csignal>
#include <mutex>
#include <thread>
#include <vector>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Leftovers {
  std::mutex mutex;
  std::vector<fs::path> paths;
};

/// Never destroyed: the thread that waits for signals may outlive everything else.
Leftovers& leftovers() {
  static Leftovers& all = *new Leftovers;
  return all;
}

/// Those that the user has not set aside (nohup).
sigset_t stopping_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) == 0 && now.sa_handler != SIG_IGN)
      sigaddset(&signals, number);
  }
  return signals;
}

void remove_all(const Leftovers& left) {
  std::error_code ignored;
  for (const fs::path& path : left.paths) fs::remove_all(path, ignored);
}

/// Ends the process as the signal would have.
[[noreturn]] void end_by(int number, const sigset_t& signals) {
  const std::lock_guard<std::mutex> held(leftovers().mutex);
  remove_all(leftovers());
  std::signal(number, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  std::raise(number);
  std::abort();
}

}  // namespace

void remove_leftovers() {
  if (const std::unique_lock<std::mutex> held(leftovers().mutex, std::try_to_lock); held)
    remove_all(leftovers());
}

void stop_without_leftovers() {
  const sigset_t signals = stopping_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int number = 0;
    if (sigwait(&signals, &number) == 0) end_by(number, signals);
  }).detach();
}

EndsWithTheRun::EndsWithTheRun(fs::path path) : path_(std::move(path)) {
  const std::lock_guard<std::mutex> held(leftovers().mutex);
  leftovers().paths.push_back(path_);
}

EndsWithTheRun::~EndsWithTheRun() {
  const std::lock_guard<std::mutex> held(leftovers().mutex);
  std::vector<fs::path>& paths = leftovers().paths;
  if (const auto own = std::find(paths.begin(), paths.end(), path_); own != paths.end())
    paths.erase(own);
}

}  // namespace mammotwin
