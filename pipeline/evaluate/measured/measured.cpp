// measured: what evaluations measured -> the pages of docs/measured.

#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate/measured/measured_page.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/toml_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path folder, evaluation;
};

void declare(CommandLine& command, Arguments& args) {
  command
      .option("folder", args.folder,
              "docs/measured: pages.toml says what its pages show, data/ holds the figures")
      .required()
      .existing_folder();
  command.option("--evaluation", args.evaluation,
                 "RESULTS/evaluation: figures there replace those of data/ first");
}

json read_json(const fs::path& path) {
  std::ifstream in(path);
  try {
    return json::parse(in);
  } catch (const json::exception& error) {
    throw std::runtime_error(path.string() + ": not JSON: " + error.what());
  }
}

/// Brings the newest figures of each page, so that a page never shows what its data does not hold.
void take_figures(const MeasuredPage& page, const Arguments& args) {
  const fs::path newest = args.evaluation / page.figures;
  if (args.evaluation.empty() || !fs::exists(newest)) return;
  write_text_atomically(args.folder / "data" / (page.name + ".json"),
                        read_json(newest).dump(1) + "\n");
}

int run(const Arguments& args) {
  json tables;
  for (const auto& [key, value] : read_toml(args.folder / "pages.toml"))
    if (key == "page") tables = value;
  for (const MeasuredPage& page : measured_pages(tables)) {
    take_figures(page, args);
    const fs::path data = args.folder / "data" / (page.name + ".json");
    if (!fs::exists(data)) {
      std::cerr << page.name << ": no figures yet (" << page.command << ")\n";
      continue;
    }
    write_text_atomically(args.folder / (page.name + ".md"),
                          measured_markdown(page, read_json(data)));
    std::cout << (args.folder / (page.name + ".md")).string() << "\n";
  }
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "measured",
                                      "Writes docs/measured from what the evaluations measured",
                                      declare, run);
}
