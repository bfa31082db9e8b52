// evaluate-strangers: real breasts registered with real mammograms of other women -> one table.

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/registration/stranger_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path cases, table, mammograms;
  std::vector<std::string> only;
  int exams = 4, jobs = 1;
  bool keep = false;
};

void declare(CommandLine& command, Arguments& args) {
  declare_cases(command, args.cases);
  declare_table(command, args.table, "strangers");
  command.option("--mammograms", args.mammograms,
                 "folder of mammograms with landmarks.csv; default: real_mammograms of cases");
  command.option("--exams", args.exams, "CC and MLO of other women, for each breast")
      .between(1, 1000)
      .with_default();
  declare_only(command, args.only);
  declare_keep(command, args.keep);
  declare_jobs(command, args.jobs);
}

/// Some of them for the breast of this number, others for the next.
std::vector<StrangersExam> exams_of(const std::vector<StrangersExam>& all, std::size_t breast,
                                    std::size_t most) {
  std::vector<StrangersExam> some;
  for (std::size_t n = 0; n < std::min(most, all.size()); ++n)
    some.push_back(all[(breast * most + n) % all.size()]);
  return some;
}

int run(const Arguments& args) {
  const std::vector<RealBreast> breasts = asked_breasts(args.cases, args.only);
  const fs::path folder =
      args.mammograms.empty() ? args.cases / "real_mammograms" : args.mammograms;
  const std::vector<ReadMammogram> mammograms = read_landmarks(folder);
  EvaluationTable table(args.table, args.keep);
  work_through(breasts.size(), args.jobs, [&](std::size_t n) {
    const std::vector<StrangersExam> exams =
        exams_of(strangers_exams(mammograms, breasts[n].side), n, args.exams);
    add_stranger_rows(breasts[n], exams, table.folder() / "strangers" / name_and_side(breasts[n]),
                      [&](const json& row) { table.add(n, row); });
  });
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-strangers",
      "Registers breasts of label maps and patients' MRI with real mammograms of other women, and "
      "writes whether that is noticed",
      declare, run);
}
