#pragma once

#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/process.h"
#include "pipeline/frame/reason.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace mammotwin {

/// One argument of a command; each call says more of it.
class Argument {
 public:
  explicit Argument(CLI::Option* option) : option_(option) {}

  Argument required();
  Argument existing_file();
  Argument existing_folder();
  Argument between(int low, int high);
  Argument between(double low, double high);
  Argument one_of(const std::vector<std::string>& values);
  Argument values(int count);  ///< so many follow it
  Argument with_default();     ///< the variable's value stands in the help
  Argument described_as(const std::string& type, const std::string& default_value);

 private:
  CLI::Option* option_;
};

/// The arguments of one command. CLI11 stays behind it: its header costs every file that sees it
/// seven seconds to compile, and its templates as much again.
class CommandLine {
 public:
  explicit CommandLine(const std::string& about);
  ~CommandLine();

  /// Positional, or `--name`. T: a path, a string, a number, an optional path, or a vector of them.
  template <class T>
  Argument option(const std::string& name, T& variable, const std::string& help);
  void flag(const std::string& name, bool& variable, const std::string& help);
  /// Prints what `text` returns, and ends.
  void text_flag(const std::string& name, std::function<std::string()> text,
                 const std::string& help);
  bool has(const std::string& name) const;  ///< after parse

  /// The exit code where the command ends here: 0 for help and version, 2 for an error, said.
  std::optional<int> parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

/// `main` of a command that is not a stage: declares its arguments, parses, runs. Exit code 2 where
/// the command line is wrong, 1 where `run` throws, else what `run` returns.
template <class Arguments, class Declare, class Run>
int run_plain_command(int argc, char** argv, const std::string& name, const std::string& about,
                      Declare declare, Run run) {
  prepare_process(argv);
  CommandLine command("mammotwin-" + name + ": " + about);
  Arguments args;
  declare(command, args);
  if (const auto code = command.parse(argc, argv)) return *code;
  try {
    return run(args);
  } catch (const std::exception& error) {
    std::cerr << name << ": " << reason_of(error) << std::endl;
    return 1;
  }
}

}  // namespace mammotwin
