#include "pipeline/cohort/histogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pipeline/cohort/html_text.h"

namespace mammotwin {
namespace {

// The drawing's own units; the page scales it.
constexpr double kWidth = 320, kMargin = 8, kBarsTop = 4, kBarsBottom = 66, kBandTop = 70,
                 kBandBottom = 78, kTextAt = 94, kHeight = 100, kDiamond = 4;
constexpr int kFewestBins = 5, kMostBins = 30;

/// Rice's rule: twice the cube root of the number of values.
int num_bins(std::size_t num_values) {
  const double rice = std::ceil(2 * std::cbrt(static_cast<double>(num_values)));
  return std::clamp(static_cast<int>(rice), kFewestBins, kMostBins);
}

class Scale {
 public:
  explicit Scale(const Distribution& d) : low_(d.smallest()), span_(d.largest() - d.smallest()) {}
  double fraction(double value) const { return (value - low_) / span_; }
  double x(double value) const { return kMargin + (kWidth - 2 * kMargin) * fraction(value); }

 private:
  double low_, span_;
};

std::string rectangle(const char* style, double x0, double x1, double y0, double y1) {
  return std::string("<rect class=\"") + style + "\" x=\"" + short_number(x0) + "\" y=\"" +
         short_number(y0) + "\" width=\"" + short_number(x1 - x0) + "\" height=\"" +
         short_number(y1 - y0) + "\"/>";
}

std::vector<int> counts_of(const Distribution& d, const Scale& scale) {
  std::vector<int> counts(num_bins(d.values.size()), 0);
  const int last = static_cast<int>(counts.size()) - 1;
  for (const auto& v : d.values) {
    const int bin = static_cast<int>(scale.fraction(v.value) * (last + 1));
    ++counts[std::clamp(bin, 0, last)];
  }
  return counts;
}

std::string bars(const Distribution& d, const Scale& scale) {
  const std::vector<int> counts = counts_of(d, scale);
  const double highest = *std::max_element(counts.begin(), counts.end());
  const double width = (kWidth - 2 * kMargin) / static_cast<double>(counts.size());
  std::string svg;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const double x = kMargin + width * static_cast<double>(i);
    const double top = kBarsBottom - (kBarsBottom - kBarsTop) * counts[i] / highest;
    svg += rectangle("bar", x + 0.5, x + width - 0.5, top, kBarsBottom);
  }
  return svg;
}

std::string diamond(double x) {
  const double y = (kBandTop + kBandBottom) / 2;
  return "<path class=\"out\" d=\"M" + short_number(x - kDiamond) + " " + short_number(y) +
         "l4 -4 4 4 -4 4z\"/>";
}

std::string text_at(double x, const char* anchor, const std::string& text) {
  return "<text x=\"" + short_number(x) + "\" y=\"" + short_number(kTextAt) + "\" text-anchor=\"" +
         anchor + "\">" + html_text(text) + "</text>";
}

std::string description(const Distribution& d) {
  return d.name + ": " + std::to_string(d.values.size()) + " patients from " +
         short_number(d.smallest()) + " to " + short_number(d.largest()) + ", median " +
         short_number(d.median) + ", middle half from " + short_number(d.first_quartile) + " to " +
         short_number(d.third_quartile) + ", " + std::to_string(d.outliers().size()) + " outliers";
}

}  // namespace

std::string unit_of(const std::string& figure_name) {
  constexpr std::array<std::pair<const char*, const char*>, 7> kUnits{{{"_mm", "mm"},
                                                                       {"_ml", "ml"},
                                                                       {"_N", "N"},
                                                                       {"_cm2", "cm²"},
                                                                       {"_deg", "degrees"},
                                                                       {"_kPa", "kPa"},
                                                                       {"_percent", "%"}}};
  for (const auto& [ending, unit] : kUnits) {
    const std::string end = ending;
    if (figure_name.size() > end.size() &&
        figure_name.compare(figure_name.size() - end.size(), end.size(), end) == 0)
      return unit;
  }
  return {};
}

std::string histogram_svg(const Distribution& d) {
  const Scale scale(d);
  std::string svg = "<svg role=\"img\" aria-label=\"" + html_text(description(d)) +
                    "\" viewBox=\"0 0 " + short_number(kWidth) + " " + short_number(kHeight) +
                    "\">" + bars(d, scale);
  svg += rectangle("band", scale.x(d.first_quartile), scale.x(d.third_quartile), kBandTop,
                   kBandBottom);
  svg += rectangle("median", scale.x(d.median) - 1, scale.x(d.median) + 1, kBandTop - 2,
                   kBandBottom + 2);
  for (const auto& v : d.outliers()) svg += diamond(scale.x(v.value));
  svg += text_at(kMargin, "start", short_number(d.smallest()));
  svg += text_at(kWidth - kMargin, "end", short_number(d.largest()));
  svg += text_at(kWidth / 2, "middle", "median " + short_number(d.median));
  return svg + "</svg>";
}

}  // namespace mammotwin
