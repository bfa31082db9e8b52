#include "pipeline/evaluate/registration/misfit_case.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "pipeline/evaluate/registration/mammogram_changes.h"
#include "pipeline/evaluate/registration/spoilt_case.h"
#include "pipeline/frame/products.h"
#include "registration/export/csv.h"
#include "registration/mammogram/mammogram_picture.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kPictures[] = {"cc.png", "mlo.png"};

/// Numbers of the views whose mammograms are exchanged.
std::vector<std::size_t> wrong_views(const std::string& misfit) {
  if (misfit.starts_with("mlo_")) return {1};
  return {0, 1};
}

/// By its halves: the outermost columns may be dark.
bool wall_at_left(const MammogramImage& image) {
  double left_over_right = 0;
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns / 2; ++column)
      left_over_right += image.at(column, row) - image.at(image.columns - 1 - column, row);
  return left_over_right > 0;
}

using Table = std::vector<std::vector<std::string>>;  // name, MRI (3), CC (2), MLO (2)

Table read_table(const fs::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": no such file");
  Table table;
  for (std::string line; std::getline(in, line);) {
    table.push_back(csv::cells(line));
    if (table.back().size() != 8) throw std::runtime_error(path.string() + ": not 8 columns");
  }
  return table;
}

void write_table(const fs::path& path, const Table& table) {
  std::string text;
  for (const auto& line : table)
    for (std::size_t n = 0; n < line.size(); ++n)
      text += line[n] + (n + 1 < line.size() ? "," : "\n");
  write_text_atomically(path, text);
}

/// Only what `register` gives a reason for is a refusal of the mammograms.
std::string end_without_product(const std::string& reason) {
  const bool refused =
      reason.starts_with("register: ") && reason.find("ended with code") == std::string::npos;
  return refused ? "refused" : "failed";
}

void turn_upside_down(const std::vector<std::size_t>& views, const fs::path& folder) {
  Table marks = read_table(folder / "landmarks.csv");
  for (const std::size_t view : views) {
    const fs::path path = folder / kPictures[view];
    const MammogramImage image = read_mammogram_picture(path);
    write_grey(path, upside_down(image));
    for (std::size_t n = 1; n < marks.size(); ++n) {
      std::string& row = marks[n][5 + 2 * view];
      row = std::to_string(image.rows - 1 - std::stod(row));
    }
  }
  write_table(folder / "landmarks.csv", marks);
}

void exchange_views(const fs::path& made, const fs::path& folder) {
  for (std::size_t view = 0; view < 2; ++view)
    fs::copy_file(made / kPictures[view], folder / kPictures[1 - view],
                  fs::copy_options::overwrite_existing);
  Table marks = read_table(folder / "landmarks.csv");
  for (std::size_t n = 1; n < marks.size(); ++n)
    for (int k = 0; k < 2; ++k) std::swap(marks[n][4 + k], marks[n][6 + k]);
  write_table(folder / "landmarks.csv", marks);
}

}  // namespace

void make_misfit_case(const fs::path& made, const fs::path& another, const std::string& misfit,
                      const fs::path& folder) {
  if (fs::exists(folder / "patient.toml")) return;
  const fs::path unfinished = folder.string() + ".part";
  copy_case(made, unfinished);
  const std::vector<std::size_t> views = wrong_views(misfit);
  if (misfit.ends_with("upside_down")) {
    turn_upside_down(views, unfinished);
  } else if (misfit == "views_exchanged") {
    exchange_views(made, unfinished);
  } else {
    for (const std::size_t view : views) {
      const MammogramImage own = read_mammogram_picture(made / kPictures[view]);
      MammogramImage shown = misfit == "other_breast"
                                 ? mirror_image(own)
                                 : read_mammogram_picture(another / kPictures[view]);
      if (misfit != "other_breast" && wall_at_left(shown) != wall_at_left(own))
        shown = mirror_image(shown);
      write_grey(unfinished / kPictures[view], shown);
    }
  }
  fs::rename(unfinished, folder);
}

void judge_misfit(const std::string& misfit, json& row) {
  const std::string names[] = {"cc", "mlo"};
  const json search = row.value("search", json::object());
  for (const std::string& view : names)
    row["end_" + view] = !row["reason"].is_null() ? end_without_product(row["reason"])
                         : search.contains(view)  ? search[view].value("end", "none")
                                                  : "none";
  const std::vector<std::size_t> wrong = wrong_views(misfit);
  const bool all_noticed = std::all_of(wrong.begin(), wrong.end(), [&](std::size_t view) {
    const std::string end = row["end_" + names[view]];
    return end == "refused" || end == "none" || end == "no registration";
  });
  const json inside = row["lesions"]["inside_90"];
  row["lesions_in_90"] = inside;
  row["noticed"] = all_noticed || (inside.is_number() && inside.get<double>() == 1);
}

}  // namespace mammotwin
