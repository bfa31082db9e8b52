#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/frame/outcome.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/progress_line.h"
#include "pipeline/frame/settings.h"
#include "pipeline/patient.h"

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

/// What the stage is going to read besides its positional inputs, and which settings it depends on.
struct StagePlan {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> setting_prefixes;
};

/// What `run` is given.
struct StageRun {
  const Patient& patient;
  Products& products;
  std::function<void(double, const std::string&)> progress;
};

/// A stage: three functions and a name.
struct Stage {
  std::string name;     ///< "fit"
  std::string summary;  ///< one sentence: what it turns into what
  std::function<void(StageDeclaration&)> declare;
  std::function<StagePlan(const Patient&)> plan;
  std::function<Outcome(StageRun&)> run;
};

/// The whole life of a stage: command line, patient.toml, "is it current already?", run, sidecar,
/// rename, exit code (0 done, 1 bad data, 2 bad usage, 3 not converged). Nothing half-written
/// stays.
int run_stage(int argc, char** argv, const Stage& stage);

/// The same for a command's three functions over its own arguments.
template <class Arguments>
int run_stage(int argc, char** argv, const std::string& name, const std::string& summary,
              void (*declare)(StageDeclaration&, Arguments&),
              StagePlan (*plan)(const Arguments&, const Patient&),
              Outcome (*run)(const Arguments&, StageRun&)) {
  Arguments args;
  return run_stage(argc, argv,
                   Stage{name, summary, [&](StageDeclaration& stage) { declare(stage, args); },
                         [&](const Patient& patient) { return plan(args, patient); },
                         [&](StageRun& stage) { return run(args, stage); }});
}

}  // namespace mammotwin
