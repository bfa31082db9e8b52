// validate-known-skins: fits to skins that are known -> how near they come, one table.

#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "pipeline/validation/known_skins.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path scan, table;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("scan", args.scan, "scan of the gel breast (.ply)").required().existing_file();
  command.option("table", args.table, "known_skins.json to write").required();
}

int run(const Arguments& args) {
  const nlohmann::json table = known_skins_table(args.scan);
  std::filesystem::create_directories(std::filesystem::absolute(args.table).parent_path());
  write_text_atomically(args.table, table.dump(1) + "\n");
  std::cout << table.dump(1) << std::endl;
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "validate-known-skins",
                                      "Fits skins that are known and writes how near it comes",
                                      declare, run);
}
