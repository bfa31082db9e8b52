#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/file_text.h"

namespace mammotwin {

/// An empty folder for one test, removed after it.
class ScratchFolder : public testing::Test {
 protected:
  ScratchFolder()
      : folder_(std::filesystem::temp_directory_path() /
                ("mammotwin-test-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  /// The message of what `action` throws; empty if it throws nothing.
  template <class Action>
  static std::string message_of(Action action) {
    try {
      action();
    } catch (const std::exception& e) {
      return e.what();
    }
    return {};
  }

  std::filesystem::path folder_;
};

}  // namespace mammotwin
