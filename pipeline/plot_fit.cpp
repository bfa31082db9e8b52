// plot-fit: prone.vtu.json -> how the fit converged, iteration by iteration, as a picture.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/validation/chart.h"

namespace mammotwin {
namespace {

constexpr double kPixelsPerPoint = 2;

struct Arguments {
  std::filesystem::path sidecar, picture;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("sidecar", args.sidecar, "prone.vtu.json of a fitted breast")
      .required()
      .existing_file();
  command.option("picture", args.picture, "picture to write (.png)").required();
}

/// What of each iteration is drawn: x counts them, y is in mm² or mm.
struct Course {
  Picture::Points cost, rms, refused_by_cost, refused_by_proof;

  explicit Course(const nlohmann::json& iterations) {
    for (std::size_t i = 0; i < iterations.size(); ++i) {
      const Eigen::Vector2d cost_here(i, iterations[i].at("cost"));
      const std::string outcome = iterations[i].at("outcome");
      if (outcome == "refused by cost") refused_by_cost.push_back(cost_here);
      if (outcome == "refused by proof") refused_by_proof.push_back(cost_here);
      cost.push_back(cost_here);
      rms.emplace_back(i, iterations[i].at("skin_rms_mm"));
    }
  }

  double least() const {
    return extreme([](double a, double b) { return std::min(a, b); });
  }
  double most() const {
    return extreme([](double a, double b) { return std::max(a, b); });
  }

 private:
  double extreme(double (*better)(double, double)) const {
    double value = cost.front().y();
    for (const Picture::Points& line : {cost, rms})
      for (const Eigen::Vector2d& point : line) value = better(value, point.y());
    return value;
  }
};

int run(const Arguments& args) {
  const auto sidecar = nlohmann::json::parse(std::ifstream(args.sidecar));
  const auto iterations = sidecar.at("quality").value("course", nlohmann::json::array());
  if (iterations.size() < 2)
    throw std::runtime_error(args.sidecar.string() +
                             ": quality.course holds no iterations; fit again (FORCE=1)");
  const Course course(iterations);
  Chart chart({"iterations of Ceres, refused steps included", 0, iterations.size() - 1.0},
              {"cost [mm²] and distance of the skin, RMS [mm]", course.least() / 1.2,
               course.most() * 8, true});
  chart.line(course.cost, palette::nipple, "cost (its weights change from stage to stage)");
  chart.line(course.rms, palette::lesion, "skin to mesh, RMS");
  chart.marks(course.refused_by_proof, palette::third_line, "step refused by the proof of det > 0");
  chart.marks(course.refused_by_cost, palette::ink, "step refused by the cost");
  chart.picture().write_png(args.picture, kPixelsPerPoint);
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "plot-fit", "Draws how a fit converged, iteration by iteration", declare, run);
}
