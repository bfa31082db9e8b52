// evaluate-supine-spread: how far inside a breast things go against the nipple as women lie back,
// and what an ellipsoid of that size holds of others -> one table.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "pipeline/evaluate/calibration/supine_spread.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/frame/command_line.h"
#include "registration/carry/supine_place.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path cases, table;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("cases", args.cases, "folder with prone_supine/points.csv")
      .required()
      .existing_folder();
  command.option("table", args.table, "supine_spread.json to write").required();
}

struct Halves {
  std::vector<WomensLandmark> one, other;
};

/// The landmarks of half of the women, drawn, and of the rest.
Halves drawn_halves(const std::vector<WomensLandmark>& all, std::mt19937& random) {
  std::vector<std::string> women;
  for (const WomensLandmark& landmark : all)
    if (std::find(women.begin(), women.end(), landmark.woman) == women.end())
      women.push_back(landmark.woman);
  std::shuffle(women.begin(), women.end(), random);
  const auto middle = women.begin() + static_cast<std::ptrdiff_t>(women.size() / 2);
  Halves halves;
  for (const WomensLandmark& landmark : all)
    (std::find(women.begin(), middle, landmark.woman) != middle ? halves.one : halves.other)
        .push_back(landmark);
  return halves;
}

/// Means over drawn halves, each tried on the rest.
nlohmann::json row_of_halves(const std::vector<WomensLandmark>& all) {
  constexpr int times = 400;
  std::mt19937 random(1);
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();
  double held = 0, landmarks = 0;
  for (int n = 0; n < times; ++n) {
    const Halves halves = drawn_halves(all, random);
    if (halves.one.empty() || halves.other.empty())
      throw std::runtime_error("landmarks of fewer than two women with nipples");
    const Eigen::Vector3d found = supine_spread(halves.one);
    spread += found / times;
    held += share_held(halves.other, found, kSupineSpreads) / times;
    landmarks += static_cast<double>(halves.other.size()) / times;
  }
  return {{"name", "half of the women, holding the rest (mean of 400 draws)"},
          {"landmarks", std::lround(landmarks)},
          {"lateral", spread.x()},
          {"posterior", spread.y()},
          {"along", spread.z()},
          {"held", held}};
}

nlohmann::json row_of_all(const std::vector<WomensLandmark>& all) {
  const Eigen::Vector3d spread = supine_spread(all);
  return {{"name", "all, holding themselves"},
          {"landmarks", all.size()},
          {"lateral", spread.x()},
          {"posterior", spread.y()},
          {"along", spread.z()},
          {"held", share_held(all, spread, kSupineSpreads)}};
}

int run(const Arguments& args) {
  const auto all = read_womens_landmarks(args.cases / "prone_supine" / "points.csv");
  EvaluationTable table(args.table);
  table.add(0, row_of_halves(all));
  table.add(1, row_of_all(all));
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-supine-spread",
      "Says how far landmarks go against their nipple as women lie back, and what an ellipsoid of "
      "that size holds of others",
      declare, run);
}
