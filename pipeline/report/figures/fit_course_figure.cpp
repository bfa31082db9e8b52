#include "pipeline/report/figures/fit_course_figure.h"

#include <algorithm>
#include <cmath>

#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

constexpr double kWidth = 460, kHeight = 190;                      // [pt]
constexpr double kLeft = 48, kRight = 8, kTop = 26, kBottom = 40;  // [pt] margins
constexpr double kFewLevels = 0.8;  // of a decade; below that 1, 2 and 5 are too few lines

/// Distance in a logarithmic scale over the iterations.
class Axes {
 public:
  explicit Axes(const std::vector<double>& rms)
      : last_(static_cast<double>(rms.size()) - 1),
        low_(std::log10(*std::min_element(rms.begin(), rms.end()) / 1.2)),
        high_(std::log10(*std::max_element(rms.begin(), rms.end()) * 1.2)) {}

  Eigen::Vector2d at(double iteration, double mm) const {
    return {
        kLeft + iteration / last_ * (kWidth - kLeft - kRight),
        kHeight - kBottom - (std::log10(mm) - low_) / (high_ - low_) * (kHeight - kTop - kBottom)};
  }

  void draw(Picture& picture) const {
    for (int power = -3; power <= 2; ++power)
      for (const int times : {1, 2, 3, 4, 5, 6, 8})
        if (high_ - low_ < kFewLevels || times == 1 || times == 2 || times == 5)
          draw_level(picture, times * std::pow(10, power));
    const double floor = std::pow(10, low_), step = std::max(1.0, std::round(last_ / 6));
    for (double i = 0; i <= last_; i += step)
      picture.text(at(i, floor) + Eigen::Vector2d(0, 14), word::number(i, 0), 9, palette::quiet,
                   Anchor::middle);
    picture.text({kLeft + (kWidth - kLeft - kRight) / 2, kHeight - 8}, "iterations of the fit", 9.5,
                 palette::ink, Anchor::middle);
    picture.text({4, 10}, "skin to mesh, RMS [mm]", 9.5, palette::ink);
  }

 private:
  void draw_level(Picture& picture, double mm) const {
    if (std::log10(mm) < low_ || std::log10(mm) > high_) return;
    const int decimals = mm >= 1 ? 0 : mm >= 0.1 ? 1 : mm >= 0.01 ? 2 : 3;
    picture.line({at(0, mm), at(last_, mm)}, {palette::grid, 0.8});
    picture.text(at(0, mm) + Eigen::Vector2d(-6, 3), word::number(mm, decimals), 9, palette::quiet,
                 Anchor::end);
  }

  double last_, low_, high_;
};

}  // namespace

std::optional<Figure> fit_course_figure(const PatientResults& results) {
  const nlohmann::json* sidecar = results.sidecar("prone.vtu");
  if (!sidecar || !sidecar->contains("quality")) return std::nullopt;
  const auto rms = (*sidecar)["quality"].value("skin_rms_by_iteration_mm", std::vector<double>{});
  if (rms.size() < 2 || *std::min_element(rms.begin(), rms.end()) <= 0) return std::nullopt;
  Picture picture(kWidth, kHeight);
  const Axes axes(rms);
  axes.draw(picture);
  Picture::Points line;
  for (std::size_t i = 0; i < rms.size(); ++i)
    line.push_back(axes.at(static_cast<double>(i), rms[i]));
  picture.line(line, {palette::nipple, 2});
  for (const Eigen::Vector2d& p : line) picture.disc(p, 2.4, palette::nipple);
  return Figure{
      picture,
      "Distance of the smoothed skin to the mesh over the fit's iterations. It may rise where "
      "the mesh is first kept from folding.",
      "Distance of the skin to the mesh over the fit: from " + word::number(rms.front(), 2) +
          " to " + word::number(rms.back(), 2) + " mm RMS in " + std::to_string(rms.size() - 1) +
          " iterations."};
}

}  // namespace mammotwin
