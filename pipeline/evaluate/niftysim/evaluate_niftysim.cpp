// evaluate-niftysim: a breast that NiftySim compressed, compressed by our solver -> how far apart
// its nodes end.

#include <iostream>

#include "pipeline/evaluate/niftysim/comparison.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

constexpr int kNotConverged = 3;

struct Arguments {
  std::filesystem::path folder, table, mesh;
  NiftySimOptions options;
  bool no_skin = false, free_roll = false;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("folder", args.folder, "with volmesh3-model.xml and volmesh3_compressed.vtk")
      .required()
      .existing_folder();
  command.option("table", args.table, "niftysim.json to write").required();
  command
      .option("--core", args.options.elements.core,
              "elements along x and y in the mesh's core, even [2 to 12]")
      .between(2, 12)
      .with_default();
  command.option("--shell", args.options.elements.shell, "elements from core to skin [1 to 6]")
      .between(1, 6)
      .with_default();
  command.option("--grad-div", args.options.grad_div, "gamma over mu [0 to 100]")
      .between(0, 100)
      .with_default();
  command.flag("--no-skin", args.no_skin, "leave the skin's membrane out");
  command.flag("--free-roll", args.free_roll, "do not hold the breast at NiftySim's roll");
  command.option("--mesh", args.mesh, "compressed mesh to write (.vtu)");
}

int run(Arguments args) {
  args.options.skin = !args.no_skin;
  args.options.held_roll = !args.free_roll;
  const NiftySimComparison result = compare_with_niftysim(args.folder, args.options);
  std::filesystem::create_directories(std::filesystem::absolute(args.table).parent_path());
  write_text_atomically(args.table, result.figures.dump(1) + "\n");
  if (!args.mesh.empty()) write_mesh_file(args.mesh, result.compressed);
  std::cerr << result.figures.dump(1) << std::endl;
  return result.reason.empty() ? 0 : kNotConverged;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-niftysim",
      "Compresses a breast as NiftySim did and compares the displacement of its nodes", declare,
      run);
}
