#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/frame/checkpoint.h"
#include "pipeline/frame/outcome.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/progress_line.h"
#include "pipeline/frame/settings_file.h"
#include "pipeline/frame/stage_declaration.h"

namespace mammotwin {

/// What the stage is going to read besides its positional inputs, and which settings it depends on.
struct StagePlan {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> setting_prefixes;
};

/// What `run` is given.
struct StageRun {
  Products& products;
  Checkpoint checkpoint;  ///< for a stage that takes long
  std::function<void(double, const std::string&)> progress;
};

/// A stage: three functions and a name.
struct Stage {
  std::string name;     ///< "fit"
  std::string summary;  ///< one sentence: what it turns into what
  std::function<void(StageDeclaration&)> declare;
  std::function<StagePlan()> plan;
  std::function<Outcome(StageRun&)> run;
  std::function<std::string()> data = {};  ///< for stdout, of a product that is there; or empty
};

/// The whole life of a stage: command line, settings file, "is it current already?", run, sidecar,
/// rename, exit code (0 done, 1 bad data, 2 bad usage, 3 not converged). Nothing half-written
/// stays. Stdout gets the stage's `data`, whether the product was made now or before.
int run_stage(int argc, char** argv, SettingsFile& file, const Stage& stage);

/// The same for a command's three functions over its own arguments and its settings file (File: a
/// SettingsFile).
template <class Arguments, class File>
int run_stage(int argc, char** argv, const std::string& name, const std::string& summary,
              void (*declare)(StageDeclaration&, Arguments&),
              StagePlan (*plan)(const Arguments&, const File&),
              Outcome (*run)(const Arguments&, const File&, StageRun&),
              std::string (*data)(const Arguments&) = nullptr) {
  Arguments args;
  File file;
  return run_stage(argc, argv, file,
                   Stage{name, summary, [&](StageDeclaration& stage) { declare(stage, args); },
                         [&] { return plan(args, file); },
                         [&](StageRun& stage) { return run(args, file, stage); },
                         [&] { return data ? data(args) : std::string(); }});
}

}  // namespace mammotwin
