#include "pipeline/report/figures/force_figure.h"

#include <algorithm>
#include <cmath>

#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

constexpr double kWidth = 460, kHeight = 250;                       // [pt]
constexpr double kLabelHeight = 12;                                 // [pt]
constexpr double kLeft = 48, kRight = 64, kTop = 14, kBottom = 40;  // [pt] margins

struct Curve {
  std::string name;
  Colour colour;
  std::vector<Eigen::Vector2d> points;  ///< thickness [mm], force [N]
};

std::vector<Curve> curves_of(const PatientResults& results) {
  std::vector<Curve> curves;
  const std::pair<const char*, Colour> views[] = {{"cc", palette::nipple},
                                                  {"mlo", palette::lesion}};
  for (const auto& [view, colour] : views) {
    const nlohmann::json* sidecar = results.sidecar(std::string(view) + ".vtu");
    if (!sidecar || !sidecar->contains("quality")) continue;
    Curve curve{title_of_view(view), colour, {}};
    const nlohmann::json& quality = (*sidecar)["quality"];
    if (quality.contains("free_thickness_mm") && quality["free_thickness_mm"].is_number())
      curve.points.emplace_back(quality["free_thickness_mm"].get<double>(), 0.0);
    for (const nlohmann::json& step : quality.value("history", nlohmann::json::array()))
      if (step.is_object() && step.contains("thickness_mm") && step.contains("force_N"))
        curve.points.emplace_back(step["thickness_mm"].get<double>(),
                                  step["force_N"].get<double>());
    if (curve.points.size() > 1) curves.push_back(std::move(curve));
  }
  return curves;
}

/// 1, 2 or 5 times a power of ten, for about five intervals.
double tick_step(double range) {
  const double raw = std::max(range, 1e-6) / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double m : {1.0, 2.0, 5.0})
    if (raw <= m * power) return m * power;
  return 10 * power;
}

/// Thickness falls to the right, as compression goes on.
struct Axes {
  double thick, thin, force;
  Eigen::Vector2d at(double thickness, double newton) const {
    return {kLeft + (thick - thickness) / (thick - thin) * (kWidth - kLeft - kRight),
            kHeight - kBottom - newton / force * (kHeight - kTop - kBottom)};
  }
};

Axes axes_for(const std::vector<Curve>& curves) {
  Axes axes{-1e300, 1e300, 1e-3};
  for (const Curve& curve : curves)
    for (const Eigen::Vector2d& p : curve.points) {
      axes.thick = std::max(axes.thick, p.x());
      axes.thin = std::min(axes.thin, p.x());
      axes.force = std::max(axes.force, p.y() * 1.08);
    }
  const double room = std::max(2.0, 0.05 * (axes.thick - axes.thin));
  axes.thick += room;
  axes.thin -= room;
  return axes;
}

void draw_axes(Picture& picture, const Axes& axes) {
  const double across = tick_step(axes.thick - axes.thin), up = tick_step(axes.force);
  for (double f = 0; f <= axes.force; f += up) {
    picture.line({axes.at(axes.thick, f), axes.at(axes.thin, f)}, {palette::grid, 0.8});
    picture.text(axes.at(axes.thick, f) + Eigen::Vector2d(-6, 3), word::number(f, up < 1 ? 1 : 0),
                 9, palette::quiet, Anchor::end);
  }
  for (double t = std::ceil(axes.thin / across) * across; t <= axes.thick; t += across)
    picture.text(axes.at(t, 0) + Eigen::Vector2d(0, 14), word::number(t, 0), 9, palette::quiet,
                 Anchor::middle);
  picture.text({kLeft + (kWidth - kLeft - kRight) / 2, kHeight - 8}, "thickness [mm]", 9.5,
               palette::ink, Anchor::middle);
  picture.text({4, kTop - 3}, "force [N]", 9.5, palette::ink);
}

}  // namespace

std::optional<Figure> force_figure(const PatientResults& results) {
  const std::vector<Curve> curves = curves_of(results);
  if (curves.empty()) return std::nullopt;
  const Axes axes = axes_for(curves);
  Picture picture(kWidth, kHeight);
  draw_axes(picture, axes);
  std::string alt = "Plate force against thickness.";
  double lowest_label = INFINITY;
  for (const Curve& curve : curves) {
    Picture::Points line;
    for (const Eigen::Vector2d& p : curve.points) line.push_back(axes.at(p.x(), p.y()));
    picture.line(line, {curve.colour, 2});
    for (const Eigen::Vector2d& p : line) picture.disc(p, 2.6, curve.colour);
    Eigen::Vector2d label = line.back() + Eigen::Vector2d(7, 3);
    if (std::abs(label.y() - lowest_label) < kLabelHeight) label.y() = lowest_label + kLabelHeight;
    lowest_label = label.y();
    picture.text(label, curve.name, 9.5, curve.colour, Anchor::start, true);
    const Eigen::Vector2d& last = curve.points.back();
    alt += " " + curve.name + ": " + word::number(last.y(), 0) + " N at " + word::mm(last.x()) +
           " mm.";
  }
  return Figure{picture, "Force on the paddle over the load steps.", alt};
}

}  // namespace mammotwin
