#include "pipeline/frame/products.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <stdexcept>

#include "pipeline/frame/partial_path.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

void rename_or_throw(const fs::path& from, const fs::path& to) {
  std::error_code error = make_durable_folders(folder_of(to));
  if (!error) fs::rename(from, to, error);
  if (error) throw std::runtime_error(to.string() + ": cannot be written: " + error.message());
}

/// Nobody else can lay anything in it.
void make_own_folder(const fs::path& folder) {
  constexpr mode_t only_for_us = 0700;
  if (mkdir(folder.c_str(), only_for_us) != 0)
    throw std::runtime_error(folder.string() + ": cannot be made: " + std::strerror(errno));
}

}  // namespace

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path whole_path(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

std::error_code make_durable_folders(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return {};
  const fs::path above = folder_of(folder);
  if (above != folder)
    if (const std::error_code failed = make_durable_folders(above)) return failed;
  fs::create_directory(folder, error);
  if (!error) make_durable(above);
  return error;
}

Products::Products(fs::path main_product) : main_(std::move(main_product)) {
  const std::error_code error = make_durable_folders(folder());
  if (error || access(folder().c_str(), W_OK) != 0)
    throw std::runtime_error(folder().string() + ": the results folder cannot be written: " +
                             (error ? error.message() : std::strerror(errno)) +
                             "; name another with RESULTS=");
}

Products::~Products() {
  std::error_code ignored;
  if (!own_folder_.empty()) fs::remove_all(own_folder_, ignored);
}

fs::path Products::folder() const { return folder_of(main_); }

fs::path Products::write(const std::string& name) {
  for (const auto& [known, path] : pending_)
    if (known == name) return path;
  if (own_folder_.empty()) {
    const std::string main_name = main_.filename().string();
    remove_partial_leftovers(folder(), main_name);
    const fs::path own = partial_path(folder(), main_name);
    own_folder_ends_ = std::make_unique<EndsWithTheRun>(own);
    make_own_folder(own);
    own_folder_ = own;
  }
  std::string flat = name;
  std::replace(flat.begin(), flat.end(), '/', '_');
  pending_.emplace_back(name, own_folder_ / flat);
  return pending_.back().second;
}

std::vector<std::string> Products::names() const {
  std::vector<std::string> names;
  for (const auto& pair : pending_) names.push_back(pair.first);
  return names;
}

void Products::commit() {
  for (const auto& [name, path] : pending_) {
    if (!fs::exists(path)) throw std::logic_error(name + " was announced but not written");
    make_durable(path);
  }
  const std::string main_name = main_.filename().string();
  std::stable_partition(pending_.begin(), pending_.end(),
                        [&](const auto& pair) { return pair.first != main_name; });
  std::set<fs::path> folders{folder()};
  for (const auto& [name, path] : pending_) {
    rename_or_throw(path, folder() / name);
    folders.insert(folder_of(folder() / name));
  }
  for (const fs::path& folder : folders) make_durable(folder);
  pending_.clear();
}

void write_text_atomically(const fs::path& path, const std::string& text) {
  const fs::path folder = folder_of(path);
  remove_partial_leftovers(folder, path.filename().string());
  const fs::path partial = partial_path(folder, path.filename().string());
  const EndsWithTheRun ends(partial);
  write_new_file(partial, text);
  try {
    rename_or_throw(partial, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
  make_durable(folder);
}

}  // namespace mammotwin
