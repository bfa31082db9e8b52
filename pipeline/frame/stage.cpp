#include "pipeline/frame/stage.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <new>

#include "pipeline/frame/memory_watch.h"
#include "pipeline/frame/partial_path.h"
#include "pipeline/frame/private_names.h"
#include "pipeline/frame/process.h"
#include "pipeline/frame/product_lock.h"
#include "pipeline/frame/reason.h"
#include "pipeline/frame/settings_table.h"
#include "pipeline/frame/sidecar.h"
#include "pipeline/frame/stop_signals.h"

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

/// What this run's files are called, and whether its products may say so.
struct Naming {
  PrivateNames names;
  bool kept = false;

  Outcome said(Outcome outcome) const {
    if (kept) return outcome;
    for (std::string& reason : outcome.reasons) reason = names.without(reason);
    outcome.quality = names.without_in(std::move(outcome.quality));
    return outcome;
  }
};

/// `given`: the settings file of the command line, if any, already read.
Naming naming_of(const SettingsFile& file, const fs::path& product,
                 const std::optional<fs::path>& given) {
  Naming naming{{}, file.keeps_names()};
  PrivateNames& names = naming.names;
  for (const NamedFile& named : file.named_files()) {
    names.add(role_of_key(named.key), file.resolve(named.path));
    names.add_text(role_of_key(named.key), named.path.string());
  }
  for (const fs::path& folder : {folder_of(product), fs::absolute(folder_of(product))})
    names.add_text("results", folder.lexically_normal().string());
  if (!given) return naming;
  for (const fs::path& form : {*given, fs::absolute(*given), given->filename()})
    names.add_text(file.subject() + ".toml", form.lexically_normal().string());
  const std::string their_folder = "the " + file.subject() + "'s folder";
  std::error_code none;
  if (!fs::equivalent(folder_of(*given), folder_of(product), none))
    names.add_files_of(their_folder, folder_of(*given));
  for (const fs::path& folder : {folder_of(*given), fs::absolute(folder_of(*given))})
    names.add_text(their_folder, folder.lexically_normal().string());
  return naming;
}

struct Attempt {
  Outcome outcome;
  Usage usage;
};

Attempt attempt(const Stage& stage, Products& products, const Checkpoint& checkpoint) {
  const auto start = std::chrono::steady_clock::now();
  Attempt a;
  ProgressLine progress(stage.name);
  try {
    StageRun run{products, checkpoint, progress.callback()};
    a.outcome = stage.run(run);
    require_reasons(a.outcome);
  } catch (const std::exception& e) {
    a.outcome = {Status::refused, {reason_of(e)}, nlohmann::json::object()};
    a.usage.starved = lacks_memory(e) || lacks_room(products.folder());
  }
  progress.finish();
  a.usage.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  a.usage.peak_memory_mb = peak_memory_mb();
  return a;
}

/// The command line as a product may say it.
std::string said_command(int argc, char** argv, const fs::path& folder, const Naming& naming) {
  if (naming.kept) return command_text(argc, argv, folder, nullptr);
  return naming.names.without(command_text(argc, argv, folder, &naming.names));
}

/// Says and writes that there is no product.
void refuse(const Stage& stage, const fs::path& product, const Provenance& provenance,
            const Naming& naming, const std::string& reason, const Usage& usage) {
  const Outcome outcome{Status::refused, {reason}, nlohmann::json::object()};
  say_outcome(stage, product, outcome, 0);
  remove_stale_outputs(product, {});
  write_sidecar(product, make_sidecar(product, provenance, naming.said(outcome), {}, usage));
}

int run_parsed(const Stage& stage, const fs::path& product, const Provenance& provenance,
               const Naming& naming, const std::string& command) {
  Products products(product);
  const Checkpoint checkpoint(product, provenance);
  const EndsWithoutMemory without_memory([&] {
    Usage usage{.command = command, .starved = true};
    usage.peak_memory_mb = peak_memory_mb();
    refuse(stage, product, provenance, naming, reason_of(std::bad_alloc()), usage);
    remove_leftovers();
  });
  Attempt a = attempt(stage, products, checkpoint);
  a.usage.command = command;
  std::vector<std::string> written;
  if (a.outcome.usable()) {
    written = products.names();
    products.commit();
  }
  remove_stale_outputs(product, written);
  const auto sidecar = make_sidecar(product, provenance, naming.said(a.outcome), written, a.usage);
  write_sidecar(product, sidecar);
  if (a.outcome.status != Status::refused) checkpoint.remove();
  say_outcome(stage, product, a.outcome, a.usage.seconds);
  if (a.outcome.usable()) say_data(stage);
  return exit_code(a.outcome.status);
}

/// A typing error must not cost a finished product: where there is one, only the message is given.
int refuse_before_running(const Stage& stage, const fs::path& product, const Naming& naming,
                          const std::string& reason) {
  std::cerr << stage.name << ": refused: " << reason << "\n";
  if (fs::exists(product)) return kBadData;
  try {
    Products products(product);
    const Outcome outcome = naming.said({Status::refused, {reason}, nlohmann::json::object()});
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

/// How a product may speak of a file: one beside it that no settings file names is another stage's.
StageInput as_input(const fs::path& path, const std::string& otherwise, const fs::path& product,
                    Naming& naming) {
  std::string role = naming.names.role_of(path);
  std::error_code none;
  const bool ours = role.empty() && fs::equivalent(folder_of(path), folder_of(product), none);
  if (ours) role = path.filename().string();
  if (role.empty()) naming.names.add(role = otherwise, path);
  return {role, path, ours || naming.kept};
}

Provenance plan_provenance(const Stage& stage, const StageDeclaration& declaration,
                           const SettingsFile& file, const Settings& settings, Naming& naming) {
  const StagePlan plan = stage.plan();
  const fs::path& product = declaration.product_path();
  std::vector<StageInput> inputs;
  for (const auto& [name, path, may_have_failed] : declaration.inputs()) {
    const bool failed = may_have_failed && !reasons_of_failure(*path).empty();
    inputs.push_back(as_input(failed ? sidecar_path(*path) : *path, name, product, naming));
  }
  for (const fs::path& path : plan.inputs)
    inputs.push_back(as_input(path, "input", product, naming));
  std::vector<std::string> prefixes = plan.setting_prefixes;
  prefixes.push_back("privacy.");
  nlohmann::json parameters = settings.parameters(prefixes);
  parameters.update(file.list_parameters(prefixes));
  return make_provenance(stage.name, parameters, inputs, product);
}

/// A pipe or a device might never end.
void require_ordinary_files(const SettingsFile& file) {
  for (const NamedFile& named : file.named_files()) {
    const fs::path path = file.resolve(named.path);
    std::error_code none;
    if (fs::exists(path, none) && !fs::is_regular_file(path, none) && !fs::is_directory(path, none))
      throw std::runtime_error(named.key + ": " + path.string() +
                               ": is a pipe or a device; expected a file or a folder");
  }
}

void say_edited(const Stage& stage, const fs::path& product) {
  if (const std::string fault = read_sidecar(product).fault; !fault.empty())
    std::cerr << stage.name << ": " << sidecar_path(product).string() << ": " << fault << "\n";
}

int run(int argc, char** argv, SettingsFile& file, const Stage& stage) {
  try {
    stop_without_leftovers();
  } catch (const std::exception& e) {
    std::cerr << stage.name << ": refused: " << reason_of(e) << "\n";
    return kBadData;
  }
  Settings settings;
  file.declare(settings);

  CommandLine command("mammotwin-" + stage.name + ": " + stage.summary);
  CommonArguments common;
  StageDeclaration declaration(command, settings);
  stage.declare(declaration);
  declare_common(command, file, settings, common);
  if (const auto code = command.parse(argc, argv)) return *code;
  const fs::path product = declaration.product_path();
  Naming naming = naming_of(file, product, common.settings_file);
  try {
    if (common.settings_file) file.read(*common.settings_file, settings);
  } catch (const std::exception& e) {
    return refuse_before_running(stage, product, naming, reason_of(e));
  }
  try {
    for (const auto& given : declaration.given())
      settings.assign_text(given.flag, given.key, given.text);
  } catch (const BadSetting& e) {
    std::cerr << stage.name << ": " << e.what() << "\n";
    return kBadUsage;
  }
  naming = naming_of(file, product, common.settings_file);
  try {
    require_ordinary_files(file);
    const ProductLock lock(product, [&] {
      std::cerr << stage.name << ": another run makes " << product.string() << "; waiting for it\n";
    });
    for (const fs::path& written : {product, sidecar_path(product)})
      remove_partial_leftovers(folder_of(product), written.filename().string());
    const Provenance provenance = plan_provenance(stage, declaration, file, settings, naming);
    if (!common.force && current_sidecar(product, provenance)) {
      Checkpoint(product, provenance).remove();  // of a run killed when it had nothing else to do
      std::cerr << stage.name << ": " << product.string() << " is up to date\n";
      say_data(stage);
      return 0;
    }
    if (!common.force)
      if (const auto failure = standing_failure(product, provenance))
        return say_standing_failure(stage, *failure);
    say_edited(stage, product);
    return run_parsed(stage, product, provenance, naming,
                      said_command(argc, argv, folder_of(product), naming));
  } catch (const std::exception& e) {
    return refuse_before_running(stage, product, naming, reason_of(e));
  }
}

}  // namespace

int run_stage(int argc, char** argv, SettingsFile& file, const Stage& stage) {
  prepare_process(argv);
  const int code = run(argc, argv, file, stage);
  if (code == kBadData && address_space_is_limited()) leave_without_destructors(code);
  return code;
}

}  // namespace mammotwin
