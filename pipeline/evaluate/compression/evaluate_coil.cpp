// evaluate-coil: drawn breasts imaged between a coil's plates -> what taking the plates off gives.

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/population.h"
#include "pipeline/evaluate/compression/coil_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastVolume_ml = 700;  // smaller ones do not hang between plates

struct Arguments {
  fs::path table;
  int synthetic = 10, first = 0, jobs = 1;
  double pressed = 0.4;
  std::vector<double> roundnesses{0, 0.8};
};

void declare(CommandLine& command, Arguments& args) {
  declare_table(command, args.table, "coil", "each breast's");
  command.option("--synthetic", args.synthetic, "breasts: the first drawn ones of 700 ml and more")
      .between(1, 50)
      .with_default();
  command.option("--first", args.first, "number of the first that is tried")
      .between(0, 10000)
      .with_default();
  command
      .option("--pressed", args.pressed,
              "share of the front half's width that plates take off; 0: no plates")
      .between(0.0, 0.6)
      .with_default();
  command.option("--roundness", args.roundnesses,
                 "asked of the unloaded breast, 0: gravity only (default 0 and 0.8)");
  declare_jobs(command, args.jobs, "breasts at a time");
}

std::vector<int> large_breasts(int first, int count) {
  std::vector<int> numbers;
  for (int n = first; static_cast<int>(numbers.size()) < count; ++n)
    if (draw_breast(n).patient.anatomy.volume_ml >= kLeastVolume_ml) numbers.push_back(n);
  return numbers;
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  const std::vector<int> numbers = large_breasts(args.first, args.synthetic);
  work_through(numbers.size(), args.jobs, [&](std::size_t n) {
    add_coil_rows({numbers[n], table.folder() / args.table.stem() / draw_breast(numbers[n]).name,
                   args.pressed, args.roundnesses},
                  [&](const nlohmann::json& row) { table.add(n, row); });
  });
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-coil",
      "Images drawn breasts between a coil's plates, lets them go, and writes how near "
      "that "
      "comes to the true shape and to where lesions truly come to lie",
      declare, run);
}
