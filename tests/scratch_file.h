#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace mammotwin {

/// Where a test may write a file of that name: in a folder of this process, so that tests may run
/// at once, removed at its end.
inline std::filesystem::path scratch_file(const std::string& name) {
  struct Folder {
    std::filesystem::path path = std::filesystem::path(testing::TempDir()) /
                                 ("mammotwin-scratch-" + std::to_string(getpid()));
    Folder() {
      std::filesystem::remove_all(path);
      std::filesystem::create_directories(path);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path / name;
}

}  // namespace mammotwin
