#include "pipeline/frame/partial_path.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr char kPartial[] = ".partial-";
constexpr std::size_t kRandomDigits = 16;

std::string random_digits() {
  std::random_device source;  // the kernel's
  std::string text;
  while (text.size() < kRandomDigits) text += "0123456789abcdef"[source() % 16];
  return text;
}

/// False for a killed process too that nobody has asked after yet (a zombie): it writes no more.
bool is_running(const std::string& pid) {
  std::ifstream in("/proc/" + pid + "/stat");  // "pid (name) state ..."
  std::string line;
  if (!std::getline(in, line)) return false;
  const std::size_t name_end = line.rfind(')');
  return name_end == std::string::npos || line.compare(name_end, 3, ") Z") != 0;
}

/// The process of a partial path for `name`; empty for any other file.
std::string writer_of(const std::string& file, const std::string& name) {
  if (!file.starts_with(kPartial)) return {};
  const std::size_t begin = sizeof(kPartial) - 1, dash = file.find('-', begin);
  const std::size_t size = name.size() + 1 + kRandomDigits;  // name, dash, random part
  if (dash == std::string::npos || file.size() != dash + 1 + size) return {};
  if (file.compare(dash + 1, name.size() + 1, name + "-") != 0) return {};
  return file.substr(begin, dash - begin);
}

[[noreturn]] void refuse(const fs::path& path) {
  throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(errno));
}

/// A file descriptor, closed in the end.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, mode_t mode = 0)
      : number_(open(path.c_str(), flags | O_CLOEXEC, mode)) {
    if (number_ < 0) refuse(path);
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

bool write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return fsync(file) == 0;
}

}  // namespace

fs::path partial_path(const fs::path& folder, const std::string& name) {
  return folder / (kPartial + std::to_string(getpid()) + "-" + name + "-" + random_digits());
}

void remove_partial_leftovers(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string pid = writer_of(entry.path().filename().string(), name);
    if (!pid.empty() && !is_running(pid)) fs::remove_all(entry.path(), ignored);
  }
}

void make_durable(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (fsync(file.number()) != 0 && errno != EINVAL) refuse(path);  // EINVAL: it has no need of it
}

void write_new_file(const fs::path& path, const std::string& text) {
  constexpr mode_t as_umask_allows = 0666;
  const Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, as_umask_allows);
  if (write_all(file.number(), text)) return;
  const int reason = errno;
  unlink(path.c_str());
  errno = reason;
  refuse(path);
}

}  // namespace mammotwin
