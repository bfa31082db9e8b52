#include "pipeline/validation/gel_figures.h"

#include <algorithm>

#include "pipeline/report/drawing/palette.h"
#include "pipeline/validation/chart.h"

namespace mammotwin {

namespace {

constexpr double kRoom = 1.1;  // an axis goes this far beyond what it shows

Colour ours() { return palette::nipple; }
Colour others() { return palette::third_line; }

}  // namespace

Picture convergence_picture(const GelResult& r) {
  Picture::Points points;
  for (const CylinderFigures& f : r.study) points.emplace_back(f.dof, f.force_N);
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x(); });
  const double expected = r.experiment.force_N.value(), error = r.experiment.force_error_N;
  double low = expected - 2 * error, high = expected + 2 * error;
  for (const auto& p : points) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  const double margin = 0.1 * (high - low);
  Chart chart({"unknowns", points.front().x() / kRoom, points.back().x() * kRoom, true},
              {"force [N], " + r.experiment.name, low - margin, high + 3 * margin});
  chart.band(expected - error, expected + error, "other codes");
  chart.line(points, ours(), "tri-cubic Hermite, trilinear pressure");
  const CylinderFigures& f = r.figures;
  chart.marks({{f.dof, f.force_N}}, palette::lesion, "recommended mesh");
  return chart.picture();
}

Picture curve_picture(const GelResult& r) {
  Picture::Points points, expected;
  for (const CylinderStep& step : r.curve) points.emplace_back(step.thickness_mm, step.force_N);
  for (const GelCurvePoint& p : r.experiment.curve)
    expected.emplace_back(p.thickness_mm, p.force_N);
  Chart chart({"thickness [mm]", points.front().x() + 1, points.back().x() - 1},
              {"force [N], " + r.experiment.name, 0, kRoom * points.back().y()});
  chart.line(points, ours(), "this solver");
  chart.marks(expected, others(), "other codes");
  return chart.picture();
}

}  // namespace mammotwin
