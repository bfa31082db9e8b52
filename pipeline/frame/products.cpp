#include "pipeline/frame/products.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr char kPartial[] = ".partial-";

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path temporary_path(const fs::path& folder, const std::string& name) {
  return folder / (kPartial + std::to_string(getpid()) + "-" + name);
}

/// False for a killed process too that nobody has asked after yet (a zombie): it writes no more.
bool is_running(const std::string& pid) {
  std::ifstream in("/proc/" + pid + "/stat");  // "pid (name) state ..."
  std::string line;
  if (!std::getline(in, line)) return false;
  const std::size_t name_end = line.rfind(')');
  return name_end == std::string::npos || line.compare(name_end, 3, ") Z") != 0;
}

/// Left by a run that was killed; a live process keeps its own.
void remove_leftovers(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string file = entry.path().filename().string();
    if (file.rfind(kPartial, 0) != 0) continue;
    const std::size_t dash = file.find('-', sizeof(kPartial) - 1);
    if (dash == std::string::npos || file.substr(dash + 1) != name) continue;
    const std::string pid = file.substr(sizeof(kPartial) - 1, dash - sizeof(kPartial) + 1);
    if (!is_running(pid)) fs::remove(entry.path(), ignored);
  }
}

void rename_or_throw(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(folder_of(to), error);
  fs::rename(from, to, error);
  if (error) throw std::runtime_error(to.string() + ": cannot be written: " + error.message());
}

}  // namespace

Products::Products(fs::path main_product) : main_(std::move(main_product)) {
  std::error_code error;
  fs::create_directories(folder(), error);
  if (error || access(folder().c_str(), W_OK) != 0)
    throw std::runtime_error(folder().string() + ": the results folder cannot be written: " +
                             (error ? error.message() : std::strerror(errno)) +
                             "; name another with RESULTS=");
}

Products::~Products() {
  std::error_code ignored;
  for (const auto& [name, path] : pending_) fs::remove(path, ignored);
}

fs::path Products::folder() const { return folder_of(main_); }

fs::path Products::write(const std::string& name) {
  for (const auto& [known, path] : pending_)
    if (known == name) return path;
  std::string flat = name;
  std::replace(flat.begin(), flat.end(), '/', '_');
  remove_leftovers(folder(), flat);
  pending_.emplace_back(name, temporary_path(folder(), flat));
  return pending_.back().second;
}

std::vector<std::string> Products::names() const {
  std::vector<std::string> names;
  for (const auto& pair : pending_) names.push_back(pair.first);
  return names;
}

void Products::commit() {
  for (const auto& [name, path] : pending_)
    if (!fs::exists(path)) throw std::logic_error(name + " was announced but not written");
  const std::string main_name = main_.filename().string();
  std::stable_partition(pending_.begin(), pending_.end(),
                        [&](const auto& pair) { return pair.first != main_name; });
  for (const auto& [name, path] : pending_) rename_or_throw(path, folder() / name);
  pending_.clear();
}

void write_text_atomically(const fs::path& path, const std::string& text) {
  remove_leftovers(folder_of(path), path.filename().string());
  const fs::path temporary = temporary_path(folder_of(path), path.filename().string());
  std::ofstream out(temporary, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw std::runtime_error(path.string() + ": cannot be written (is the disk full?)");
  }
  rename_or_throw(temporary, path);
}

}  // namespace mammotwin
