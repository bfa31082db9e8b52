// evaluate-victre: VICTRE's phantom, compressed by FEBio, compressed by our solver -> overlap.

#include <iostream>

#include "pipeline/evaluate/victre/victre_comparison.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

constexpr int kNotConverged = 3;

struct Arguments {
  std::filesystem::path folder, table;
  HalfBallElements elements;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("folder", args.folder, "with p_1 and pc_1 (.mhd, .raw.gz)")
      .required()
      .existing_folder();
  command.option("table", args.table, "victre.json to write").required();
  command.option("--core", args.elements.core, "elements along x and y in the core, even [2 to 12]")
      .between(2, 12)
      .with_default();
  command.option("--shell", args.elements.shell, "elements from core to skin [1 to 6]")
      .between(1, 6)
      .with_default();
}

int run(const Arguments& args) {
  const VictreComparison result = compare_with_victre(args.folder, args.elements);
  std::filesystem::create_directories(std::filesystem::absolute(args.table).parent_path());
  write_text_atomically(args.table, result.figures.dump(1) + "\n");
  std::cerr << result.figures.dump(1) << std::endl;
  return result.reason.empty() ? 0 : kNotConverged;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-victre",
      "Compresses VICTRE's phantom as FEBio did and compares tissue and outline", declare, run);
}
