#include "pipeline/report/figures/overview_picture.h"

#include <algorithm>
#include <vector>

#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/figures/mri_figure.h"
#include "pipeline/report/figures/render_figure.h"
#include "pipeline/report/view_figures.h"

namespace mammotwin {
namespace {

constexpr double kGap = 16;  // [pt]

/// Pictures side by side on white.
Picture beside(const std::vector<Picture>& pictures) {
  double width = kGap, height = 0;
  for (const Picture& p : pictures) {
    width += p.width() + kGap;
    height = std::max(height, p.height());
  }
  Picture row(width, height + kGap);
  double x = kGap;
  for (const Picture& p : pictures) {
    row.place(p, x, kGap);
    x += p.width() + kGap;
  }
  return row;
}

}  // namespace

Picture overview_picture(const PatientResults& results) {
  std::vector<Picture> rows;
  const std::vector<Landmark> lesions = results.lesions();
  if (results.segmentation && !lesions.empty())
    rows.push_back(beside({mri_figure(results, lesions.front()).picture}));
  if (results.prone) {
    std::vector<Picture> breasts, detectors;
    for (const BreastShape& shape : breast_shapes(results))
      breasts.push_back(render_figure(results, shape).picture);
    for (const ViewResult& view : results.views)
      detectors.push_back(detector_figures(results, view).back().whole());
    rows.push_back(beside(breasts));
    if (!detectors.empty()) rows.push_back(beside(detectors));
  }
  double width = kGap, height = kGap;
  for (const Picture& row : rows) {
    width = std::max(width, row.width());
    height += row.height();
  }
  Picture sheet(width, height);
  sheet.rectangle(0, 0, width, height, palette::paper);
  double y = 0;
  for (const Picture& row : rows) {
    sheet.place(row, (width - row.width()) / 2, y);
    y += row.height();
  }
  return sheet;
}

}  // namespace mammotwin
