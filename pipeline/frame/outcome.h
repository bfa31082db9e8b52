#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// How a stage ended. `look`: done, but a person should look at it first.
enum class Status { ok, look, refused, not_converged };

/// "ok", "look", "refused", "not_converged".
std::string name_of(Status status);

/// The process's exit code: 0 for ok and look, 1 for refused, 3 for not_converged.
int exit_code(Status status);

/// What a stage says of its work; products are kept only when it is usable.
struct Outcome {
  Status status = Status::ok;
  std::vector<std::string> reasons;                   ///< sentences; empty only when ok
  nlohmann::json quality = nlohmann::json::object();  ///< names carry their units
  bool usable() const { return status == Status::ok || status == Status::look; }
};

}  // namespace mammotwin
