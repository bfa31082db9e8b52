#include "pipeline/report/figures/convergence_figure.h"

#include <algorithm>

#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

constexpr double kWidth = 460, kHeight = 150;                      // [pt]
constexpr double kLeft = 48, kRight = 8, kTop = 26, kBottom = 30;  // [pt] margins
constexpr double kGap = 6;                                         // [pt] between bars

struct Bar {
  std::string label;  ///< thickness [mm] that the step reached, or "end"
  int iterations;
};
struct Series {
  std::string name;
  Colour colour;
  std::vector<Bar> bars;
};

std::optional<Series> series_of(const PatientResults& results, const std::string& view,
                                const Colour& colour) {
  const nlohmann::json* sidecar = results.sidecar(view + ".vtu");
  if (!sidecar || !sidecar->contains("quality")) return std::nullopt;
  const nlohmann::json& quality = (*sidecar)["quality"];
  Series series{title_of_view(view), colour, {}};
  int counted = 0;
  for (const nlohmann::json& step : quality.value("history", nlohmann::json::array()))
    if (step.is_object() && step.contains("iterations") && step.contains("thickness_mm")) {
      const int iterations = step["iterations"].get<int>();
      series.bars.push_back({word::number(step["thickness_mm"].get<double>(), 0), iterations});
      counted += iterations;
    }
  if (series.bars.empty()) return std::nullopt;
  series.bars.push_back(
      {"end", std::max(0, quality.value("newton_iterations", counted) -
                              quality.value("other_press_iterations", 0) - counted)});
  return series;
}

}  // namespace

std::optional<Figure> convergence_figure(const PatientResults& results) {
  std::vector<Series> all;
  const std::pair<const char*, Colour> views[] = {{"cc", palette::nipple},
                                                  {"mlo", palette::lesion}};
  for (const auto& [view, colour] : views)
    if (auto series = series_of(results, view, colour)) all.push_back(std::move(*series));
  if (all.empty()) return std::nullopt;
  int count = static_cast<int>(all.size()) - 1, most = 1;  // a free place between views
  for (const Series& series : all)
    for (const Bar& bar : series.bars) {
      ++count;
      most = std::max(most, bar.iterations);
    }
  Picture picture(kWidth, kHeight);
  const double pitch = (kWidth - kLeft - kRight) / count, scale = (kHeight - kTop - kBottom) / most;
  const double floor = kHeight - kBottom;
  picture.text({kLeft + (kWidth - kLeft - kRight) / 2, kHeight - 4}, "thickness reached [mm]", 9.5,
               palette::ink, Anchor::middle);
  std::string alt = "Newton iterations of each load step.";
  double x = kLeft;
  for (const Series& series : all) {
    picture.text({x, kTop - 12}, series.name + ", iterations", 9.5, series.colour, Anchor::start,
                 true);
    int sum = 0;
    for (const Bar& bar : series.bars) {
      const double height = scale * bar.iterations, width = std::max(1.0, pitch - kGap);
      picture.rectangle(x, floor - height, width, height, series.colour);
      picture.text({x + width / 2, floor - height - 3}, std::to_string(bar.iterations), 8,
                   palette::quiet, Anchor::middle);
      picture.text({x + width / 2, floor + 11}, bar.label, 8, palette::quiet, Anchor::middle);
      x += pitch;
      sum += bar.iterations;
    }
    x += pitch;
    alt += " " + series.name + ": " + std::to_string(sum) + " in all.";
  }
  return Figure{
      picture,
      "Newton iterations of each load step; at the end the gap is closed and the thickness "
      "corrected.",
      alt};
}

}  // namespace mammotwin
