// A library to preload (LD_PRELOAD): between a program and the disk. It watches one folder
// (FAULT_FOLDER), counts what is done there (files opened for writing, writes, renames, removals,
// new folders, fsync; of writes every FAULT_EVERY_WRITE-th), over all processes that share
// FAULT_COUNTER (a file of two numbers of 8 bytes: steps, and all writes), and
// - kills the group of processes before step FAULT_KILL_AT;
// - keeps in FAULT_STORE what a loss of power would leave: a file's bytes (content-INODE) and a
//   folder's entries (entries-INODE) as they were at its last fsync.
// faults.h puts the disk together from that.

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

bool is_watched(const std::string& path) {
  static const std::string folder = setting("FAULT_FOLDER");
  return !folder.empty() && path.compare(0, folder.size(), folder) == 0;
}

std::string absolute(const char* path) {
  if (path[0] == '/') return path;
  char here[PATH_MAX];
  return getcwd(here, sizeof here) ? std::string(here) + "/" + path : std::string(path);
}

std::string path_of(int file) {
  char path[PATH_MAX];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = readlink(link.c_str(), path, sizeof path);
  return size > 0 ? std::string(path, static_cast<std::size_t>(size)) : std::string();
}

struct Counters {
  std::atomic<long> steps, writes;
};

/// Null where nothing is counted.
Counters* counters() {
  static Counters* const shared = [] {
    const std::string path = setting("FAULT_COUNTER");
    const int file =
        path.empty() ? -1 : real<int(const char*, int, ...)>("open")(path.c_str(), O_RDWR);
    void* memory =
        file < 0 ? MAP_FAILED
                 : mmap(nullptr, sizeof(Counters), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file >= 0) close(file);
    return memory == MAP_FAILED ? nullptr : static_cast<Counters*>(memory);
  }();
  return shared;
}

/// One step in the watched folder; the last thing that is done where it is the one to die at.
void step() {
  static const long last = std::atol(setting("FAULT_KILL_AT").c_str());
  if (counters() && counters()->steps.fetch_add(1) + 1 == last) {
    kill(0, SIGKILL);
    pause();
  }
}

void step_of_write() {
  static const long every = std::max(1L, std::atol(setting("FAULT_EVERY_WRITE").c_str()));
  if (counters() && counters()->writes.fetch_add(1) % every == 0) step();
}

std::string stored(const char* what, ino_t inode) {
  return setting("FAULT_STORE") + "/" + what + "-" + std::to_string(inode);
}

bool keeps() {
  static const bool keeps = !setting("FAULT_STORE").empty();
  return keeps;
}

/// All of `bytes`, past the hooks.
void put(int file, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t done = real<ssize_t(int, const void*, size_t)>("write")(file, bytes, size);
    if (done <= 0) return;
    bytes += done, size -= static_cast<std::size_t>(done);
  }
}

int create(const std::string& path) {
  return real<int(const char*, int, ...)>("open")(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
}

void keep_content(const std::string& path, ino_t inode) {
  const int from = real<int(const char*, int, ...)>("open")(path.c_str(), O_RDONLY);
  const int to = create(stored("content", inode));
  char buffer[1 << 16];
  for (ssize_t n; from >= 0 && to >= 0 && (n = read(from, buffer, sizeof buffer)) > 0;)
    put(to, buffer, static_cast<std::size_t>(n));
  close(from);
  close(to);
}

void keep_entries(const std::string& path, ino_t inode) {
  std::string lines;
  if (DIR* folder = opendir(path.c_str())) {
    while (const dirent* entry = readdir(folder))
      if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0)
        lines += std::to_string(entry->d_ino) + (entry->d_type == DT_DIR ? " d " : " f ") +
                 entry->d_name + "\n";
    closedir(folder);
  }
  const int to = create(stored("entries", inode));
  put(to, lines.data(), lines.size());
  close(to);
}

int sync(int file, const char* name) {
  const std::string path = path_of(file);
  if (!is_watched(path)) return real<int(int)>(name)(file);
  step();
  const int result = real<int(int)>(name)(file);
  struct stat info {};
  if (result == 0 && keeps() && fstat(file, &info) == 0)
    S_ISDIR(info.st_mode) ? keep_entries(path, info.st_ino) : keep_content(path, info.st_ino);
  return result;
}

/// A file that is new has nothing on the disk, whatever had its number before.
void forget(const std::string& path) {
  struct stat info {};
  if (!keeps() || stat(path.c_str(), &info) != 0) return;
  for (const char* what : {"content", "entries"})
    real<int(const char*)>("unlink")(stored(what, info.st_ino).c_str());
}

template <class Open>
auto open_counted(const char* path, bool writes, Open open) {
  const std::string whole = absolute(path);
  const bool counts = writes && is_watched(whole);
  if (!counts) return open();
  step();
  const bool is_new = access(whole.c_str(), F_OK) != 0;
  const auto result = open();
  if (is_new) forget(whole);
  return result;
}

int open_file(const char* name, const char* path, int flags, mode_t mode) {
  return open_counted(path, (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0,
                      [&] { return real<int(const char*, int, ...)>(name)(path, flags, mode); });
}

FILE* open_stream(const char* name, const char* path, const char* mode) {
  return open_counted(path, std::strpbrk(mode, "wa+") != nullptr,
                      [&] { return real<FILE*(const char*, const char*)>(name)(path, mode); });
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_file("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_file("open64", path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) { return open_stream("fopen", path, mode); }
FILE* fopen64(const char* path, const char* mode) { return open_stream("fopen64", path, mode); }

ssize_t write(int file, const void* bytes, size_t size) {
  if (file > 2 && is_watched(path_of(file))) step_of_write();
  return real<ssize_t(int, const void*, size_t)>("write")(file, bytes, size);
}

ssize_t writev(int file, const iovec* pieces, int count) {
  if (file > 2 && is_watched(path_of(file))) step_of_write();
  return real<ssize_t(int, const iovec*, int)>("writev")(file, pieces, count);
}

int fclose(FILE* stream) {
  if (is_watched(path_of(fileno(stream)))) step();
  return real<int(FILE*)>("fclose")(stream);
}

int rename(const char* from, const char* to) {
  if (is_watched(absolute(to))) step();
  return real<int(const char*, const char*)>("rename")(from, to);
}

int unlink(const char* path) {
  if (is_watched(absolute(path))) step();
  return real<int(const char*)>("unlink")(path);
}

int remove(const char* path) {
  if (is_watched(absolute(path))) step();
  return real<int(const char*)>("remove")(path);
}

int mkdir(const char* path, mode_t mode) {
  const bool watched = is_watched(absolute(path));
  if (watched) step();
  const int result = real<int(const char*, mode_t)>("mkdir")(path, mode);
  if (watched && result == 0) forget(absolute(path));
  return result;
}

int fsync(int file) { return sync(file, "fsync"); }
int fdatasync(int file) { return sync(file, "fdatasync"); }

}  // extern "C"
