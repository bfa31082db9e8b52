// evaluate-outlines: compressed CC breasts -> how their outlines compare with real patients'.

#include <algorithm>
#include <cstdio>

#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/read_mammogram.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/outline_row.h"
#include "pipeline/evaluate/compression/typical_press.h"
#include "pipeline/frame/command_line.h"
#include "registration/mammogram/mammogram_picture.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path population, table;
  std::optional<fs::path> mammograms;
  std::vector<std::string> views;
  bool press = false;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("population", args.population, "folder with PCAmean.csv, PCA1.csv ...")
      .required()
      .existing_folder();
  command.option("table", args.table, "outlines.json to write").required();
  command.option("views", args.views, "breasts compressed in CC (cc.vtu)")
      .required()
      .existing_file();
  command
      .option("--mammograms", args.mammograms,
              "folder of mammograms with landmarks.csv: how much deeper their medial half is")
      .existing_folder();
  command.flag("--press", args.press,
               "press each breast to the thickness that is typical of its volume first, from what "
               "stands beside it "
               "(segmentation.seg.nrrd, fractions.nrrd, unloaded.vtu or prone.vtu, and "
               "patient.toml if it is there); results go to the "
               "folder outlines beside the table");
}

/// A CC that somebody read, hung as usual: medial is below.
json row_of(const ReadMammogram& read) {
  const double columns = mammogram_picture_size(read.file).columns;
  const auto depth = [&](const Eigen::Vector2d& x) {
    return read.wall_at_left ? x.x() : columns - 1 - x.x();
  };
  const auto& skin = read.skin;
  return {{"group", "mammogram"},
          {"name", read.file.stem().string()},
          {"medial_deeper", (depth(skin[2]) - depth(skin[0])) / depth(skin[1])}};
}

void add_mammograms(const fs::path& folder, std::size_t first, EvaluationTable& table) {
  for (const ReadMammogram& read : read_landmarks(folder))
    if (!read.oblique() && read.skin.size() == 3) {
      json row = row_of(read);
      const std::string line = row["name"].get<std::string>();
      table.add(first++, std::move(row), line);
    }
}

std::string line_of(const json& row) {
  if (row["within_2_sd"].is_null()) return row["name"].get<std::string>() + ": none";
  char line[240];
  std::snprintf(line, sizeof line,
                "%-30s %5.1f mm (typical %.0f)  within 2 sd %3.0f %%, mean %+.1f, worst %+.1f sd; "
                "depth %.0f (%.0f), "
                "width %.0f (%.0f) mm, %.0f (%.0f) ml",
                row["name"].get<std::string>().c_str(), row["thickness_mm"].get<double>(),
                row["typical_thickness_mm"].get<double>(), 100 * row["within_2_sd"].get<double>(),
                row["mean_sd"].get<double>(), row["worst_sd"].get<double>(),
                row["depth_mm"].get<double>(), row["population_depth_mm"].get<double>(),
                row["width_mm"].get<double>(), row["population_width_mm"].get<double>(),
                row["volume_ml"].get<double>(), row["population_volume_ml"].get<double>());
  return line;
}

/// The deepest folder that has all of these below it.
fs::path common_folder(const std::vector<fs::path>& folders) {
  fs::path common = folders.front().parent_path();
  for (const fs::path& folder : folders) {
    const fs::path above = folder.parent_path();
    while (std::mismatch(common.begin(), common.end(), above.begin(), above.end()).first !=
           common.end())
      common = common.parent_path();
  }
  return common;
}

/// What the sidecar says that the view was made with; null where it does not.
json parameter_of(const fs::path& view, const char* key) {
  const json sidecar = stage_sidecar(view);
  if (sidecar.is_null() || !sidecar.at("parameters").contains(key)) return nullptr;
  return sidecar.at("parameters").at(key).at("value");
}

int run(const Arguments& args) {
  const OutlinePopulation population(args.population);
  EvaluationTable table(args.table);
  const fs::path beside = table.folder() / "outlines";
  std::vector<fs::path> folders;
  for (const std::string& view : args.views)
    folders.push_back(fs::absolute(view).lexically_normal().parent_path());
  const fs::path common = common_folder(folders);
  for (std::size_t n = 0; n < args.views.size(); ++n) {
    const std::string& view = args.views[n];
    const fs::path name = folders[n].lexically_relative(common);
    const fs::path path =
        args.press ? press_typically(view, folders[n], population, beside / name) : fs::path(view);
    json row = outline_row(read_mesh_file(path), population);
    row["group"] = "model";
    row["name"] = name.string();
    row["tissue"] = parameter_of(path, "materials.preset");
    row["most_pull_n"] = parameter_of(path, "compress.most_pull_n");
    add_press(path, row);
    const std::string line = line_of(row);
    table.add(n, std::move(row), line);
  }
  if (args.mammograms) add_mammograms(*args.mammograms, args.views.size(), table);
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
