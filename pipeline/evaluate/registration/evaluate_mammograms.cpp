// evaluate-mammograms: mammograms with landmarks read by eye -> how far off what is found lies.

#include <cmath>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate/registration/mammogram_rows.h"
#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "registration/export/png_file.h"
#include "registration/mammogram/findings_picture.h"
#include "registration/mammogram/mammogram_picture.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path folder, table;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("folder", args.folder, "mammograms (PNG) and landmarks.csv")
      .required()
      .existing_folder();
  command.option("table", args.table, "mammograms.json to write; mammograms.png goes beside it")
      .required();
}

constexpr int kTileHeight = 500;

double cpu_seconds(std::clock_t since) {
  return static_cast<double>(std::clock() - since) / CLOCKS_PER_SEC;
}

/// Reads, finds and compares one mammogram; `tile` becomes its picture.
json row_of(const ReadMammogram& read, ColourPicture& tile) {
  json row{{"file", read.file.filename().string()}, {"view", read.view}};
  const MammogramImage image = read_mammogram_picture(read.file);
  MammogramFindings found;
  const std::clock_t begun = std::clock();
  try {
    found = find_breast(image, read.pixel_mm, read.oblique());
    row.update(mammogram_row(read, found));
    row.update(positioning_row(read, found.outline, image.columns));
  } catch (const std::runtime_error& error) {
    row["refused"] = error.what();
    row["unsure"] = {"outline", "nipple", "pectoral"};
  }
  row["seconds"] = cpu_seconds(begun);
  row.update(noticed_row(read, image));
  tile = findings_picture(image, read.pixel_mm, found, kTileHeight, read.marks());
  return row;
}

ColourPicture contact_sheet(const std::vector<ColourPicture>& tiles) {
  constexpr int kAcross = 8;
  int width = 1;
  for (const ColourPicture& tile : tiles) width = std::max(width, tile.columns + 2);
  const int down = (static_cast<int>(tiles.size()) + kAcross - 1) / kAcross;
  ColourPicture sheet(kAcross * width, down * (kTileHeight + 2), {60, 30, 30});
  for (std::size_t n = 0; n < tiles.size(); ++n)
    sheet.paste(tiles[n], static_cast<int>(n % kAcross) * width,
                static_cast<int>(n / kAcross) * (kTileHeight + 2));
  return sheet;
}

int run(const Arguments& args) {
  json cases = json::array();
  std::vector<ColourPicture> tiles;
  for (const ReadMammogram& read : read_landmarks(args.folder)) {
    tiles.emplace_back(1, 1);
    cases.push_back(row_of(read, tiles.back()));
    std::cerr << cases.back().dump() << std::endl;
  }
  const json counts = mammogram_counts(cases);
  Products products(args.table);
  write_png(products.write(args.table.stem().string() + ".png"), contact_sheet(tiles));
  commit_counted(counts, cases, products);
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-mammograms",
      "Compares what is found in mammograms with what was read in them by eye", declare, run);
}
