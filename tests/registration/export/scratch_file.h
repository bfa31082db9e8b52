#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace mammotwin {

/// Where a test may write a file of that name.
inline std::filesystem::path scratch_file(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

}  // namespace mammotwin
