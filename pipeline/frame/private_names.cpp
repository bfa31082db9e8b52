#include "pipeline/frame/private_names.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

bool is_number(const std::string& name) {
  return name.find_first_not_of("0123456789.") == std::string::npos;
}

bool tells_something(const std::string& name) {
  constexpr std::size_t shortest = 3, shortest_number = 5;
  return name.size() >= (is_number(name) ? shortest_number : shortest);
}

bool stands_at(const std::string& name, const std::string& text, std::size_t at) {
  const bool number = is_number(name);
  const auto goes_on = [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || (number && c == '.');
  };
  return text.compare(at, name.size(), name) == 0 && (at == 0 || !goes_on(text[at - 1])) &&
         (at + name.size() == text.size() || !goes_on(text[at + name.size()]));
}

/// Role, and the file's checksum where it can be read.
std::string said_of(const std::string& role, const fs::path& file) {
  constexpr std::size_t digits = 12;
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return role;
  try {
    return role + " " + sha256_of_path(file).substr(0, digits);
  } catch (const std::exception&) {
    return role;
  }
}

}  // namespace

std::string role_of_key(const std::string& key) {
  std::string role = key;
  for (const std::string prefix : {"views.", "compress.", "unload."})
    if (role.starts_with(prefix)) role.erase(0, prefix.size());
  if (role.ends_with(".path")) role.resize(role.size() - std::string(".path").size());
  std::replace_if(
      role.begin(), role.end(), [](char c) { return c == '.' || c == '_'; }, ' ');
  return role;
}

void PrivateNames::add(const std::string& role, const fs::path& path) {
  std::error_code none;
  if (path.empty()) return;
  roles_.try_emplace(whole_path(path).string(), role);
  for (const fs::path& form : {path, whole_path(path), fs::absolute(path).lexically_normal(),
                               path.lexically_normal(), path.filename()})
    meanings_.try_emplace(form.string(), Meaning{role, path});
  if (fs::is_directory(path, none)) add_files_of(role, path);
}

void PrivateNames::add_files_of(const std::string& role, const fs::path& folder) {
  constexpr int deepest = 4, most = 50000;  // somebody's home, where patient.toml lies there
  std::error_code none;
  int count = 0;
  for (fs::recursive_directory_iterator at(folder, none), end; at != end && count < most;
       at.increment(none), ++count) {
    if (at.depth() >= deepest) at.disable_recursion_pending();
    for (const fs::path& form : {at->path(), at->path().filename()})
      meanings_.try_emplace(form.string(), Meaning{"a file of the " + role, {}});
  }
}

void PrivateNames::add_text(const std::string& role, const std::string& name) {
  meanings_.try_emplace(name, Meaning{role, {}});
}

std::string PrivateNames::role_of(const fs::path& path) const {
  const auto found = roles_.find(whole_path(path).string());
  return found == roles_.end() ? std::string() : found->second;
}

std::string PrivateNames::without(const std::string& text) const {
  std::string said;
  for (std::size_t at = 0; at < text.size();) {
    const std::pair<const std::string, Meaning>* longest = nullptr;
    for (const auto& known : meanings_)
      if (tells_something(known.first) && stands_at(known.first, text, at) &&
          (!longest || known.first.size() > longest->first.size()))
        longest = &known;
    said += longest ? said_of(longest->second.role, longest->second.file) : text.substr(at, 1);
    at += longest ? longest->first.size() : 1;
  }
  return said;
}

nlohmann::json PrivateNames::without_in(nlohmann::json value) const {
  if (value.is_structured())
    for (nlohmann::json& entry : value) entry = without_in(std::move(entry));
  else if (value.is_string() && value.get_ref<const std::string&>().find(' ') != std::string::npos)
    value = without(value.get<std::string>());
  return value;
}

}  // namespace mammotwin
