#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace mammotwin {

/// Named numbers of a mesh file, as MeshFile::metadata holds them.
using Metadata = std::map<std::string, std::vector<double>>;

/// The numbers called `key`, or null where `file` has none. Throws std::runtime_error naming file
/// and field where there are more or fewer than `count`.
inline const std::vector<double>* find_field(const Metadata& metadata, const std::string& file,
                                             const std::string& key, std::size_t count) {
  const auto found = metadata.find(key);
  if (found == metadata.end()) return nullptr;
  if (found->second.size() != count)
    throw std::runtime_error(file + ": the field " + key + " has " +
                             std::to_string(found->second.size()) + " numbers; expected " +
                             std::to_string(count));
  return &found->second;
}

}  // namespace mammotwin
