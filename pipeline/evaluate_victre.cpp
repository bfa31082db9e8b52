// evaluate-victre: VICTRE's phantom, compressed by FEBio, compressed by our solver -> overlap.

#include <CLI/CLI.hpp>
#include <iostream>

#include "pipeline/evaluate/victre/victre_comparison.h"
#include "pipeline/frame/plain_command.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

constexpr int kNotConverged = 3;

struct Arguments {
  std::filesystem::path folder, table;
  HalfBallElements elements;
};

void declare(CLI::App& app, Arguments& args) {
  app.add_option("folder", args.folder, "with p_1 and pc_1 (.mhd, .raw.gz)")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("table", args.table, "victre.json to write")->required();
  app.add_option("--core", args.elements.core, "elements along x and y in the core, even [2 to 12]")
      ->check(CLI::Range(2, 12))
      ->capture_default_str();
  app.add_option("--shell", args.elements.shell, "elements from core to skin [1 to 6]")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
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
  return run_plain_command<Arguments>(argc, argv, "evaluate-victre",
                                   "Compresses VICTRE's phantom as FEBio did and compares tissue and outline",
                                   declare, run);
}
