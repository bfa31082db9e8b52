#include "pipeline/frame/stage.h"

#include <algorithm>
#include <chrono>
#include <iostream>

#include "pipeline/frame/process.h"
#include "pipeline/frame/settings_table.h"
#include "pipeline/frame/sidecar.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr int kBadData = 1;
constexpr int kBadUsage = 2;

struct CommonArguments {
  std::optional<fs::path> settings_file;
  bool force = false;
};

void declare_common(CommandLine& command, const SettingsFile& file, const Settings& settings,
                    CommonArguments& common) {
  const std::string subject = file.subject();
  command.option("--" + subject, common.settings_file,
                 subject + ".toml with this " + subject + "'s settings");
  command.flag("--force", common.force, "run even if the product is current");
  command.text_flag(
      "--list-settings", [&] { return settings_table(settings, file.list_settings()); },
      "print every key of " + subject + ".toml as a table");
}

void require_reasons(const Outcome& outcome) {
  if (outcome.status != Status::ok && outcome.reasons.empty())
    throw std::logic_error("a stage ended without success and without a reason");
}

void say_outcome(const Stage& stage, const fs::path& product, const Outcome& outcome,
                 double seconds) {
  for (const std::string& reason : outcome.reasons)
    std::cerr << stage.name << ": " << name_of(outcome.status) << ": " << reason << "\n";
  if (outcome.usable())
    std::cerr << stage.name << ": wrote " << product.string() << " in "
              << minutes_and_seconds(seconds) << "\n";
}

void say_data(const Stage& stage) {
  if (stage.data) std::cout << stage.data() << std::flush;
}

/// Nothing of an earlier run lies beside a sidecar that speaks of another: neither the product of a
/// stage that has failed since, nor a file that is not written any more.
void remove_stale_outputs(const fs::path& product, const std::vector<std::string>& written) {
  std::vector<std::string> stale = former_outputs(product);
  stale.push_back(product.filename().string());
  std::error_code ignored;
  for (const std::string& name : stale)
    if (std::find(written.begin(), written.end(), name) == written.end())
      fs::remove(product.parent_path() / name, ignored);
}

/// So little that a stage may have failed for it alone.
bool lacks_room(const fs::path& folder) {
  constexpr std::uintmax_t least_bytes = 64u << 20;  // more than any stage writes on a large MRI
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  return error || space.available < least_bytes;
}

struct Attempt {
  Outcome outcome;
  Usage usage;
};

Attempt attempt(const Stage& stage, Products& products, const Checkpoint& checkpoint, int argc,
                char** argv) {
  const auto start = std::chrono::steady_clock::now();
  Attempt a;
  ProgressLine progress(stage.name);
  try {
    StageRun run{products, checkpoint, progress.callback()};
    a.outcome = stage.run(run);
    require_reasons(a.outcome);
  } catch (const std::bad_alloc&) {
    a.outcome = {Status::refused, {"there is not enough memory for this input"}, {}};
    a.usage.starved = true;
  } catch (const std::exception& e) {
    a.outcome = {Status::refused, {e.what()}, nlohmann::json::object()};
    a.usage.starved = lacks_room(products.folder());
  }
  progress.finish();
  a.usage.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  a.usage.peak_memory_mb = peak_memory_mb();
  a.usage.command = command_text(argc, argv, products.folder());
  return a;
}

int run_parsed(const Stage& stage, const fs::path& product, const Provenance& provenance, int argc,
               char** argv) {
  Products products(product);
  const Checkpoint checkpoint(product, provenance);
  const Attempt a = attempt(stage, products, checkpoint, argc, argv);
  std::vector<std::string> written;
  if (a.outcome.usable()) {
    written = products.names();
    products.commit();
  }
  remove_stale_outputs(product, written);
  const auto sidecar = make_sidecar(product, provenance, a.outcome, written, a.usage);
  write_sidecar(product, sidecar);
  if (a.outcome.status != Status::refused) checkpoint.remove();
  say_outcome(stage, product, a.outcome, a.usage.seconds);
  if (a.outcome.usable()) say_data(stage);
  return exit_code(a.outcome.status);
}

/// A typing error must not cost a finished product: where there is one, only the message is given.
int refuse_before_running(const Stage& stage, const fs::path& product, const std::string& reason) {
  std::cerr << stage.name << ": refused: " << reason << "\n";
  if (fs::exists(product)) return kBadData;
  try {
    Products products(product);
    const Outcome outcome{Status::refused, {reason}, nlohmann::json::object()};
    const auto provenance = make_provenance(stage.name, nlohmann::json::object(), {}, product);
    write_sidecar(product, make_sidecar(product, provenance, outcome, {}, {}));
  } catch (const std::exception& e) {
    std::cerr << stage.name << ": " << e.what() << "\n";
  }
  return kBadData;
}

/// Says what the sidecar of a failure says; returns its exit code.
int say_standing_failure(const Stage& stage, const nlohmann::json& sidecar) {
  const std::string status = sidecar.at("status");
  for (const nlohmann::json& reason : sidecar.value("reasons", nlohmann::json::array()))
    std::cerr << stage.name << ": " << status << ": " << reason.get<std::string>() << "\n";
  std::cerr << stage.name << ": nothing has changed since, so it is not run again (--force does)\n";
  return exit_code(status == name_of(Status::refused) ? Status::refused : Status::not_converged);
}

Provenance plan_provenance(const Stage& stage, const StageDeclaration& declaration,
                           const SettingsFile& file, const Settings& settings) {
  const StagePlan plan = stage.plan();
  std::vector<fs::path> inputs;
  for (const fs::path* input : declaration.inputs()) inputs.push_back(*input);
  inputs.insert(inputs.end(), plan.inputs.begin(), plan.inputs.end());
  nlohmann::json parameters = settings.parameters(plan.setting_prefixes);
  parameters.update(file.list_parameters(plan.setting_prefixes));
  return make_provenance(stage.name, parameters, inputs, declaration.product_path());
}

}  // namespace

int run_stage(int argc, char** argv, SettingsFile& file, const Stage& stage) {
  prepare_process(argv);
  Settings settings;
  file.declare(settings);

  CommandLine command("mammotwin-" + stage.name + ": " + stage.summary);
  CommonArguments common;
  StageDeclaration declaration(command, settings);
  stage.declare(declaration);
  declare_common(command, file, settings, common);
  if (const auto code = command.parse(argc, argv)) return *code;
  const fs::path product = declaration.product_path();
  try {
    if (common.settings_file) file.read(*common.settings_file, settings);
  } catch (const std::exception& e) {
    return refuse_before_running(stage, product, e.what());
  }
  try {
    for (const auto& given : declaration.given())
      settings.assign_text(given.flag, given.key, given.text);
  } catch (const BadSetting& e) {
    std::cerr << stage.name << ": " << e.what() << "\n";
    return kBadUsage;
  }
  try {
    const Provenance provenance = plan_provenance(stage, declaration, file, settings);
    if (!common.force && current_sidecar(product, provenance)) {
      std::cerr << stage.name << ": " << product.string() << " is up to date\n";
      say_data(stage);
      return 0;
    }
    if (!common.force)
      if (const auto failure = standing_failure(product, provenance))
        return say_standing_failure(stage, *failure);
    return run_parsed(stage, product, provenance, argc, argv);
  } catch (const std::exception& e) {
    return refuse_before_running(stage, product, e.what());
  }
}

}  // namespace mammotwin
