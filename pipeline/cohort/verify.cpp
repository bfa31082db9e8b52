// verify: are the files of a patient's results still those that their sidecars speak of?

#include <iostream>

#include "pipeline/cohort/verify_results.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

constexpr int kBadData = 1;

struct Arguments {
  std::filesystem::path results, data;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("results", args.results, "a patient's results folder").required();
  command
      .option("--data", args.data,
              "the patient's folder, to check the inputs that came from there, too")
      .existing_folder();
}

int run(const Arguments& args) {
  const std::string folder = args.results.string();
  const Verification found = verify_results(args.results, args.data);
  for (const std::string& difference : found.differences)
    std::cout << folder << ": " << difference << "\n";
  std::cout << folder << ": " << found.files_checked << " inputs and products checked, "
            << found.differences.size() << " differences\n";
  return found.differences.empty() ? 0 : kBadData;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "verify",
      "recomputes the checksums of all inputs and products of a patient's results and says what "
      "differs from the sidecars. Exit code 1 if anything does.",
      declare, run);
}
