#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace mammotwin {

/// All bytes of a file; empty where there is none.
inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace mammotwin
