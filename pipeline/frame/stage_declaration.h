#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/frame/command_line.h"
#include "pipeline/frame/settings.h"

namespace mammotwin {

/// What a stage needs on its command line: inputs, then the product, as positional paths; options
/// from the settings that concern it.
class StageDeclaration {
 public:
  StageDeclaration(CommandLine& command, Settings& settings)
      : command_(command), settings_(settings) {}

  void input(const std::string& name, std::filesystem::path& variable, const std::string& help);
  /// One that the stage can do without where the stage before found no answer: then what says so,
  /// `<input>.json`, is read in its place.
  void input_or_failure(const std::string& name, std::filesystem::path& variable,
                        const std::string& help);
  void product(const std::string& name, std::filesystem::path& variable, const std::string& help);
  /// Every setting below `prefix` becomes an option: `prefix` is cut off if it is the stage's own,
  /// dots and underscores become dashes.
  void options_from(const std::string& prefix, bool cut_prefix);
  CommandLine& command() { return command_; }

  struct Given {
    std::string flag, key, text;
  };
  struct Input {
    std::string name;  ///< on the command line
    std::filesystem::path* path;
    bool may_have_failed;
  };
  const std::vector<Input>& inputs() const { return inputs_; }
  std::filesystem::path& product_path() const { return *product_; }
  std::vector<Given> given() const;

 private:
  CommandLine& command_;
  Settings& settings_;
  std::vector<Input> inputs_;
  std::filesystem::path* product_ = nullptr;
  std::vector<std::shared_ptr<Given>> options_;
};

}  // namespace mammotwin
