#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <string>

namespace mammotwin {

/// The message of what `call` throws; "" (and a failure) if it throws nothing.
template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

inline void expect_mentions(const std::string& message, std::initializer_list<std::string> words) {
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << "\"" << word << "\" not in: " << message;
}

/// A folder that vanishes with the test.
struct EmptyFolder {
  std::filesystem::path path;
  explicit EmptyFolder(const std::string& name)
      : path(std::filesystem::temp_directory_path() /
             ("mammotwin_" + std::to_string(getpid()) + "_" + name)) {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~EmptyFolder() { std::filesystem::remove_all(path); }
};

}  // namespace mammotwin
