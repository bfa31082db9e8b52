// synthesize-scan: the laser scan of a mannequin-like gel breast.

#include "pipeline/frame/command_line.h"
#include "pipeline/synthesize/gel_breast.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path scan;
  int seed = 1;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("scan", args.scan, "points to write (.ply)").required();
  command.option("--seed", args.seed, "of the random numbers").with_default();
}

int run(const Arguments& args) {
  write_point_ply(args.scan, gel_breast_scan(args.seed));
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "synthesize-scan",
      "the simulated laser scan of a gel breast (noise 0.3 mm, holes, outliers)", declare, run);
}
