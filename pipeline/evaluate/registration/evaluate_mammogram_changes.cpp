// evaluate-mammogram-changes: mammograms, changed in ways that must not matter -> what moves.

#include <iostream>
#include <map>

#include "pipeline/evaluate/registration/mammogram_changes.h"
#include "pipeline/evaluate/registration/mammogram_rows.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "registration/mammogram/mammogram_picture.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path folder, table;
  std::string only;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("folder", args.folder, "mammograms (PNG) and landmarks.csv")
      .required()
      .existing_folder();
  command.option("table", args.table, "mammogram_changes.json to write").required();
  command.option("--only", args.only, "images whose names begin so");
}

json row_of(const ReadMammogram& read, const MammogramFindings& first,
            const ChangedMammogram& changed) {
  try {
    return change_row(first, find_breast(changed.image, changed.pixel_mm, read.oblique()), changed);
  } catch (const std::runtime_error& error) {
    return {{"refused", error.what()}, {"moved", json::array({"outline"})}, {"held", false}};
  }
}

void add_rows(const ReadMammogram& read, json& cases) {
  const MammogramImage image = read_mammogram_picture(read.file);
  const MammogramFindings first = find_breast(image, read.pixel_mm, read.oblique());
  for (const MammogramChange& change : mammogram_changes()) {
    json row{{"file", read.file.filename().string()}, {"view", read.view}, {"change", change.name}};
    row.update(row_of(read, first, change.apply(image, read.pixel_mm, first.chest_wall)));
    std::cerr << row.dump() << std::endl;
    cases.push_back(row);
  }
}

/// By change: images in which something that was sure moved.
json counts_of(const json& cases) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const json& row : cases) {
    auto& of_change = counts[row["change"]];
    ++of_change["images"];
    for (const std::string what : row["moved"]) ++of_change[what];
  }
  return counts;
}

int run(const Arguments& args) {
  json cases = json::array();
  for (const ReadMammogram& read : read_landmarks(args.folder))
    if (read.file.filename().string().rfind(args.only, 0) == 0) add_rows(read, cases);
  const json counts = counts_of(cases);
  Products products(args.table);
  commit_counted(counts, cases, products);
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-mammogram-changes",
      "Changes mammograms in ways that must not matter, and writes how far findings move", declare,
      run);
}
