// evaluate-registration: synthetic patients with known marks, from MRI and mammograms -> one table.

#include <functional>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/registration/ellipse_rows.h"
#include "pipeline/evaluate/registration/misfit_case.h"
#include "pipeline/evaluate/registration/registration_case.h"
#include "pipeline/evaluate/registration/registration_rows.h"
#include "pipeline/evaluate/registration/spoilt_case.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "pipeline/patient/tissue_presets.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path table;
  std::string preset = kDefaultTissue;
  int synthetic = 10, first = 0, jobs = 2;
  bool coarse = false, hard = false, fatty = false, spoil = false, misfit = false, judge = false;
};

void declare(CommandLine& command, Arguments& args) {
  declare_table(command, args.table, "registration", "each patient's");
  command.option("--synthetic", args.synthetic, "patients").between(1, 10000).with_default();
  command.option("--first", args.first, "the first of them").between(0, 10000).with_default();
  declare_jobs(command, args.jobs, "patients at a time, each on all cores");
  command.flag("--coarse", args.coarse,
               "few elements in the truth and in the model: seconds a patient, to try it out");
  command.flag("--hard", args.hard,
               "patients further from the registering model: other laws, springs and friction, "
               "large rolls and turns, detector's edges, muscle, abdomen, skin folds; MRI between "
               "a coil's plates, with a nipple, chest wall or region that is off");
  command.flag("--fatty", args.fatty, "the patients with next to no gland");
  command.flag(
      "--spoil", args.spoil,
      "each patient also with mammograms of which the search is told wrongly: no nipple in "
      "profile, a pectoral edge 10 mm off, a strip of abdomen");
  command.flag(
      "--misfit", args.misfit,
      "each patient also with mammograms that are not what patient.toml says: another "
      "patient's, the other breast's, upside down, views exchanged, her CC beside an MLO that "
      "is another patient's or upside down");
  command
      .option("--preset", args.preset,
              "materials.preset of the model that registers; the truth's is neo_hookean_2026")
      .with_default();
  command.flag("--judge", args.judge, "judge what lies there, without making or running anything");
}

json evaluate(const fs::path& folder, const std::function<void()>& make, const Arguments& args) {
  json row = empty_registration_row();
  row["name"] = folder.filename().string();
  row["reason"] = nullptr;
  try {
    if (!args.judge) {
      make();
      take_tissue(args.preset, folder);
      run_registration_case(folder);
    }
    row.update(registration_row(folder));
  } catch (const std::exception& error) {
    row["reason"] = error.what();
  }
  return row;
}

std::string line_of(const json& row) {
  std::ostringstream line;
  line << row["name"] << " " << row["reason"] << " CC " << row["tre_cc_mm"] << " MLO "
       << row["tre_mlo_mm"] << " 3-D " << row["tre_3d_mm"] << " mm";
  return line.str();
}

struct Drawn {
  Difficulty difficulty = Difficulty::easy;
  std::string prefix = "synthetic-";  ///< of their folders
};

Drawn drawn_by(const Arguments& args) {
  if (args.coarse + args.hard + args.fatty > 1)
    throw std::runtime_error("--coarse, --hard and --fatty are patients of three kinds: name one");
  if (args.hard) return {Difficulty::hard, "hard-"};
  if (args.fatty) return {Difficulty::fatty, "fatty-"};
  return {args.coarse ? Difficulty::coarse : Difficulty::easy};
}

/// The folder of patient n + 1, whose mammograms are shown as those of patient n.
fs::path another_patient(int number, const Arguments& args, const fs::path& folder) {
  const fs::path next = folder.parent_path() / ("mammograms-" + std::to_string(number + 1));
  if (!args.judge) make_registration_case(number + 1, drawn_by(args).difficulty, next);
  return next;
}

void add_misfits(int number, const fs::path& folder, const Arguments& args,
                 const std::function<void(json, const std::string&)>& add) {
  const fs::path another = another_patient(number, args, folder);
  for (const std::string misfit : kMisfits) {
    const fs::path wrong = folder.string() + "-" + misfit;
    json row = evaluate(
        wrong, [&] { make_misfit_case(folder, another, misfit, wrong); }, args);
    judge_misfit(misfit, row);
    add(std::move(row), misfit);
  }
}

int run(const Arguments& args) {
  const Drawn drawn = drawn_by(args);
  EvaluationTable table(args.table);
  work_through(args.synthetic, args.jobs, [&](std::size_t n) {
    const int number = args.first + static_cast<int>(n);
    const std::string name = drawn.prefix + std::to_string(number);
    const fs::path folder = table.folder() / "registration" / name;
    const auto add = [&](json row, const std::string& spoilt) {
      row["spoilt"] = spoilt;
      const std::string line = line_of(row);
      table.add(n, std::move(row), line);
    };
    add(evaluate(
            folder, [&] { make_registration_case(number, drawn.difficulty, folder); }, args),
        "nothing");
    if (args.spoil)
      for (const std::string spoil : kSpoils) {
        const fs::path worse = folder.string() + "-" + spoil;
        add(evaluate(
                worse, [&] { spoil_registration_case(folder, spoil, worse); }, args),
            spoil);
      }
    if (args.misfit) add_misfits(number, folder, args, add);
  });
  if (args.spoil || args.misfit) return 0;
  write_text_atomically(table.folder() / (args.table.stem().string() + "_ellipses.json"),
                        json{{"cases", ellipse_rows(table.rows())}}.dump(1) + "\n");
  std::cerr << registration_summary(table.rows());
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "evaluate-registration",
                                      "Registers synthetic patients with mammograms of another "
                                      "model, and writes how far off the marks are",
                                      declare, run);
}
