// validate-other-fits: fits that Ceres does not do, done by it as well -> two tables.

#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "pipeline/validation/other_fits/skin_slab_fits.h"
#include "pipeline/validation/other_fits/stiffness_fits.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path folder;
};

void declare(CommandLine& command, Arguments& args) {
  command
      .option("folder", args.folder,
              "folder to write skin_slab_fits.json and stiffness_fits.json to")
      .required();
}

int run(const Arguments& args) {
  std::filesystem::create_directories(args.folder);
  write_text_atomically(args.folder / "skin_slab_fits.json", skin_slab_fits().dump(1) + "\n");
  write_text_atomically(args.folder / "stiffness_fits.json", stiffness_fits().dump(1) + "\n");
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "validate-other-fits",
      "Fits the skin's thickness and the stiffness that a second state asks for with Ceres, too, "
      "and writes how both ways fare",
      declare, run);
}
