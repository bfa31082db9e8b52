#include "pipeline/frame/product_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

bool lock(int file, int how) {
  while (flock(file, LOCK_EX | how) != 0)
    if (errno != EINTR) return false;
  return true;
}

/// The one before removes the file when it has ended: a lock of what is gone keeps nobody out.
bool is_still_there(const fs::path& path, int file) {
  struct stat now {
  }, ours{};
  return stat(path.c_str(), &now) == 0 && fstat(file, &ours) == 0 && now.st_ino == ours.st_ino &&
         now.st_dev == ours.st_dev;
}

}  // namespace

ProductLock::ProductLock(const fs::path& product, const std::function<void()>& say_waiting)
    : path_(folder_of(product) / ("." + product.filename().string() + ".lock")) {
  constexpr mode_t only_for_us = 0600;
  bool said = false;
  make_durable_folders(folder_of(product));  // Products says where it cannot be made
  for (;;) {
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, only_for_us);
    if (file_ < 0) return;
    if (!lock(file_, LOCK_NB)) {
      if (errno == EWOULDBLOCK && !said) say_waiting(), said = true;
      if (errno != EWOULDBLOCK || !lock(file_, 0)) return;
    }
    if (is_still_there(path_, file_)) break;
    close(file_);
  }
  ends_.emplace(path_);
}

ProductLock::~ProductLock() {
  if (file_ < 0) return;
  ends_.reset();
  unlink(path_.c_str());
  close(file_);
}

}  // namespace mammotwin
