#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// What a stage needs on its command line: inputs, then the product, as positional paths; options
/// from the settings that concern it.
class StageDeclaration {
 public:
  StageDeclaration(CLI::App& app, Settings& settings) : app_(app), settings_(settings) {}

  void input(const std::string& name, std::filesystem::path& variable, const std::string& help);
  void product(const std::string& name, std::filesystem::path& variable, const std::string& help);
  /// Every setting below `prefix` becomes an option: `prefix` is cut off if it is the stage's own,
  /// dots and underscores become dashes.
  void options_from(const std::string& prefix, bool cut_prefix);
  CLI::App& app() { return app_; }

  struct Given {
    std::string flag, key, text;
  };
  const std::vector<std::filesystem::path*>& inputs() const { return inputs_; }
  std::filesystem::path& product_path() const { return *product_; }
  std::vector<Given> given() const;

 private:
  CLI::App& app_;
  Settings& settings_;
  std::vector<std::filesystem::path*> inputs_;
  std::filesystem::path* product_ = nullptr;
  std::vector<std::shared_ptr<Given>> options_;
};

}  // namespace mammotwin
