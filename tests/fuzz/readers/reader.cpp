#include "tests/fuzz/readers/reader.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// Removed with this process.
struct OwnFolder {
  fs::path path = fs::temp_directory_path() / ("mammotwin-fuzz-" + std::to_string(getpid()));
  OwnFolder() { fs::create_directories(path); }
  ~OwnFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

fs::path fuzzed_file(const std::string& name, const std::string& bytes) {
  static const OwnFolder folder;
  std::ofstream(folder.path / name, std::ios::binary) << bytes;
  return folder.path / name;
}

bool is_said_to_a_user(const std::string& message, const std::string& bytes) {
  if (message.find(' ') == std::string::npos) return false;
  for (const char* word : {"::_M_", "json.exception", "std::", "itk::", "vtk"})
    if (message.find(word) != std::string::npos && bytes.find(word) == std::string::npos)
      return false;
  return true;
}

}  // namespace mammotwin
