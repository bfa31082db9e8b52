#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/where.h"

/// Defines `folder`, the named folder of data made by others, or skips the test and says so.
#define MAMMOTWIN_NEED_CASE(folder, name)                                               \
  const std::filesystem::path folder = std::filesystem::path(MAMMOTWIN_CASES) / (name); \
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent"
