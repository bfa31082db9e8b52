// mammotwin-verify: are the files of a patient's results still those that their sidecars speak of?

#include <CLI/CLI.hpp>
#include <iostream>

#include "pipeline/cohort/verify_results.h"

namespace {
constexpr int kBadData = 1, kBadUsage = 2;

int run(const std::filesystem::path& folder) {
  const mammotwin::Verification found = mammotwin::verify_results(folder);
  for (const std::string& difference : found.differences)
    std::cout << folder.string() << ": " << difference << "\n";
  std::cout << folder.string() << ": " << found.files_checked << " inputs and products checked, "
            << found.differences.size() << " differences\n";
  return found.differences.empty() ? 0 : kBadData;
}
}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "mammotwin-verify: recomputes the checksums of all inputs and products of a patient's "
      "results "
      "and says what differs from the sidecars. Exit code 1 if anything does.");
  std::filesystem::path folder;
  app.add_option("results", folder, "a patient's results folder")->required();
  app.set_version_flag("--version", std::string(MAMMOTWIN_VERSION));
  try {
    app.parse(argc, argv);
    return run(folder);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kBadUsage;
  } catch (const std::exception& e) {
    std::cerr << "verify: " << e.what() << "\n";
    return kBadData;
  }
}
