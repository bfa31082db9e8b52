#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "pipeline/frame/stop_signals.h"

namespace mammotwin {

/// One run at a time makes a product: the lock of a hidden file beside it, gone when this goes out
/// of scope. Where it cannot be had (a folder that cannot be written, a file system without locks),
/// the run goes on without.
class ProductLock {
 public:
  /// Waits while another run holds it, after `say_waiting`.
  ProductLock(const std::filesystem::path& product, const std::function<void()>& say_waiting);
  ~ProductLock();
  ProductLock(const ProductLock&) = delete;
  ProductLock& operator=(const ProductLock&) = delete;

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::optional<EndsWithTheRun> ends_;
};

}  // namespace mammotwin
