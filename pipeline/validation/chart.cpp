#include "pipeline/validation/chart.h"

#include <cmath>
#include <cstdio>

#include "pipeline/report/drawing/palette.h"

namespace mammotwin {

namespace {

constexpr double kWidth = 420, kHeight = 270;                       // [pt]
constexpr double kLeft = 56, kRight = 18, kTop = 24, kBottom = 40;  // [pt] margins
constexpr double kText = 9.5;

/// 1, 2 or 5 times a power of ten, for about five intervals.
double tick_step(double range) {
  const double raw = range / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double m : {1.0, 2.0, 5.0})
    if (raw <= m * power) return m * power;
  return 10 * power;
}

std::vector<double> ticks(const ChartAxis& axis) {
  const double low = std::min(axis.first, axis.last), high = std::max(axis.first, axis.last);
  std::vector<double> values;
  if (axis.logarithmic) {
    for (double power = std::pow(10, std::floor(std::log10(low))); power <= high; power *= 10)
      for (const double m : {1.0, 2.0, 5.0})
        if (m * power >= low && m * power <= high) values.push_back(m * power);
    return values;
  }
  const double step = tick_step(high - low);
  for (double v = std::ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step)
    values.push_back(v);
  return values;
}

double fraction(const ChartAxis& axis, double value) {
  return axis.logarithmic ? std::log(value / axis.first) / std::log(axis.last / axis.first)
                          : (value - axis.first) / (axis.last - axis.first);
}

std::string tick_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", std::abs(value) < 1e-12 ? 0 : value);
  return text;
}

}  // namespace

Chart::Chart(ChartAxis across, ChartAxis up)
    : across_(std::move(across)), up_(std::move(up)), picture_(kWidth, kHeight) {
  picture_.rectangle(0, 0, kWidth, kHeight, palette::paper);
  draw_axes();
}

Eigen::Vector2d Chart::at(const Eigen::Vector2d& value) const {
  return {kLeft + fraction(across_, value.x()) * (kWidth - kLeft - kRight),
          kHeight - kBottom - fraction(up_, value.y()) * (kHeight - kTop - kBottom)};
}

void Chart::draw_axes() {
  for (double v : ticks(up_)) {
    const Eigen::Vector2d place = at({across_.first, v});
    picture_.line({place, at({across_.last, v})}, {palette::grid, 0.8});
    picture_.text(place + Eigen::Vector2d(-6, 3), tick_text(v), kText, palette::quiet, Anchor::end);
  }
  for (double v : ticks(across_))
    picture_.text(at({v, up_.first}) + Eigen::Vector2d(0, 14), tick_text(v), kText, palette::quiet,
                  Anchor::middle);
  picture_.text({kLeft + (kWidth - kLeft - kRight) / 2, kHeight - 8}, across_.label, kText,
                palette::ink, Anchor::middle);
  picture_.text({4, kTop - 12}, up_.label, kText, palette::ink);
}

void Chart::name_in_legend(const std::string& name, const Colour& colour, bool ring) {
  const double y = kTop + 8 + 14 * names_++;
  const Eigen::Vector2d place(kLeft + 14, y);
  if (ring)
    picture_.circle(place, 3.4, {colour, 1.4});
  else
    picture_.disc(place, 2.8, colour);
  picture_.text(place + Eigen::Vector2d(9, 3), name, kText, palette::ink);
}

void Chart::band(double low, double high, const std::string& name) {
  const Colour tint = palette::with_alpha(palette::third_line, 0.25);
  const Eigen::Vector2d corner = at({across_.first, high}), other = at({across_.last, low});
  picture_.rectangle(corner.x(), corner.y(), other.x() - corner.x(),
                     std::max(1.0, other.y() - corner.y()), tint);
  picture_.text(other + Eigen::Vector2d(-4, 12), name, kText, palette::third_line, Anchor::end);
}

void Chart::line(const Picture::Points& values, const Colour& colour, const std::string& name) {
  Picture::Points places;
  for (const auto& v : values) places.push_back(at(v));
  picture_.line(places, {colour, 1.6});
  for (const auto& place : places) picture_.disc(place, 2.8, colour);
  name_in_legend(name, colour, false);
}

void Chart::marks(const Picture::Points& values, const Colour& colour, const std::string& name) {
  for (const auto& v : values) picture_.circle(at(v), 4.6, {colour, 1.4});
  name_in_legend(name, colour, true);
}

}  // namespace mammotwin
