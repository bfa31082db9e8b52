#include "pipeline/frame/reason.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <typeinfo>

namespace mammotwin {
namespace {

/// Words of a library for programmers, or one word that names a function ("stod").
bool speaks_to_programmers(const std::exception& error) {
  return dynamic_cast<const nlohmann::json::exception*>(&error) ||
         dynamic_cast<const std::length_error*>(&error) ||
         dynamic_cast<const std::out_of_range*>(&error) ||
         dynamic_cast<const std::bad_cast*>(&error) ||
         std::string(error.what()).find(' ') == std::string::npos;
}

}  // namespace

bool lacks_memory(const std::exception& error) {
  const std::string no_thread = std::strerror(EAGAIN);  // of std::thread, ITK and TBB
  return dynamic_cast<const std::bad_alloc*>(&error) ||
         std::string(error.what()).find(no_thread) != std::string::npos;
}

std::string reason_of(const std::exception& error) {
  if (lacks_memory(error))
    return "there is not enough memory for this input (is it limited, by ulimit -v or the batch "
           "system?)";
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return file->path1().string() + ": " + file->code().message();
  if (!speaks_to_programmers(error)) return error.what();
  return "an input holds what this program does not foresee; expected files as its stages or a "
         "scanner wrote them, whole: run the stages before again with FORCE=1, and export the "
         "patient's files again if that does not help";
}

}  // namespace mammotwin
