#pragma once

#include <string>
#include <vector>

namespace mammotwin {

struct CommandResult {
  int exit_code;
  std::string text;  ///< stdout and stderr, as they came
};

/// Runs a program without a shell in between; `environment` entries are "NAME=value".
CommandResult run_command(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment = {});

/// The same in a group of its own: what kills the group (exit code 137) spares the caller.
CommandResult run_command_in_group(const std::vector<std::string>& arguments,
                                   const std::vector<std::string>& environment);

/// Starts a program in a group of its own, kills the whole group after `seconds` and waits until
/// all of it is gone; false if it had ended by itself. What it says is not kept.
bool run_and_kill_after(double seconds, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& environment = {});

}  // namespace mammotwin
