// evaluate-outlines: compressed CC breasts -> how their outlines compare with real patients'.

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "pipeline/evaluate/outline_row.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path population, table;
  std::vector<std::string> views;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("population", args.population, "folder with PCAmean.csv, PCA1.csv ...")
      .required()
      .existing_folder();
  command.option("table", args.table, "outlines.json to write").required();
  command.option("views", args.views, "breasts compressed in CC (cc.vtu)").required().existing_file();
}

void say(const json& row) {
  if (row["within_2_sd"].is_null()) return;
  char line[200];
  std::snprintf(line, sizeof line,
                "%-24s %5.1f mm  within 2 sd %3.0f %%, mean %+.1f, worst %+.1f sd; depth %.0f (%.0f), "
                "width %.0f (%.0f) mm\n",
                row["name"].get<std::string>().c_str(), row["thickness_mm"].get<double>(),
                100 * row["within_2_sd"].get<double>(), row["mean_sd"].get<double>(),
                row["worst_sd"].get<double>(), row["depth_mm"].get<double>(),
                row["population_depth_mm"].get<double>(), row["width_mm"].get<double>(),
                row["population_width_mm"].get<double>());
  std::cerr << line;
}

int run(const Arguments& args) {
  const OutlinePopulation population(args.population);
  json cases = json::array();
  for (const std::string& view : args.views) {
    const fs::path path = view;
    json row = outline_row(read_mesh_file(path), population);
    row["name"] = fs::absolute(path).parent_path().filename().string();
    say(row);
    cases.push_back(std::move(row));
  }
  fs::create_directories(fs::absolute(args.table).parent_path());
  write_text_atomically(args.table, json{{"cases", cases}}.dump(1) + "\n");
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-outlines",
      "Compares outlines of breasts compressed in CC with a population of real ones", declare, run);
}
