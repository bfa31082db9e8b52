#include "pipeline/report/drawing/panel.h"

#include <algorithm>

#include "pipeline/report/drawing/palette.h"

namespace mammotwin {
namespace {

constexpr double kSmall = 8;   // [pt] text beside marks
constexpr double kLabel = 10;  // [pt] names on a view
constexpr double kMark = 4.5;  // [pt] half size of a cross or triangle
constexpr double kEdge = 1.0;  // [pt] light and dark edges of a mark

}  // namespace

void Panel::pieces(const Pieces& pieces, const Stroke& stroke) {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> on_paper;
  for (const auto& [a, b] : pieces) on_paper.emplace_back(at(a), at(b));
  picture_.clip(x_, y_, width(), height());
  picture_.segments(on_paper, stroke);
  picture_.unclip();
}

void Panel::edged_pieces(const Pieces& line, const Colour& colour, double width) {
  pieces(line, {palette::dark_edge, width + 4 * kEdge});
  pieces(line, {palette::light_edge, width + 2 * kEdge});
  pieces(line, {colour, width});
}

void Panel::edge_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  picture_.line({at(from), at(to)}, {palette::plate, 1.2, {4, 3}});
}

void Panel::frame() {
  picture_.outline(
      {{x_, y_}, {x_ + width(), y_}, {x_ + width(), y_ + height()}, {x_, y_ + height()}},
      {palette::quiet, 0.6});
}

void Panel::sides(const std::string& left, const std::string& right, const std::string& top,
                  const std::string& bottom, bool on_image) {
  const Colour colour = on_image ? palette::paper : palette::quiet;
  const double middle_x = x_ + width() / 2, middle_y = y_ + height() / 2 + kSmall / 3;
  picture_.text({x_ + 4, middle_y}, left, kSmall, colour, Anchor::start, true, on_image);
  picture_.text({x_ + width() - 4, middle_y}, right, kSmall, colour, Anchor::end, true, on_image);
  picture_.text({middle_x, y_ + kSmall + 3}, top, kSmall, colour, Anchor::middle, true, on_image);
  picture_.text({middle_x, y_ + height() - 4}, bottom, kSmall, colour, Anchor::middle, true,
                on_image);
}

void Panel::scale_bar(double mm, const Colour& colour) {
  const double right = x_ + width() - 8, y = y_ + height() - 8;
  picture_.line({{right - mm * scale_, y}, {right, y}}, {colour, 2});
  picture_.text({right - mm * scale_ / 2, y - 4}, std::to_string(static_cast<int>(mm)) + " mm",
                kSmall - 1, colour, Anchor::middle);
}

void Panel::title(const std::string& text) {
  picture_.text({x_, y_ - 5}, text, 9, palette::ink, Anchor::start, true);
}

void Panel::label(const Eigen::Vector3d& x, double away_mm, const std::string& text) {
  const Eigen::Vector2d p = at(x);
  picture_.text({p.x() + away_mm * scale_ + 3, p.y() + 3}, text, kLabel, palette::paper,
                Anchor::start, true, true);
}

void Panel::lesion_mark(const Eigen::Vector3d& x, double radius_mm, const std::string& name,
                        bool on_image) {
  const Eigen::Vector2d p = at(x);
  const double radius = std::max(radius_mm * scale_, 4.0);
  picture_.circle(p, radius, {palette::dark_edge, 1.8 + 4 * kEdge});
  picture_.circle(p, radius, {palette::light_edge, 1.8 + 2 * kEdge});
  picture_.circle(p, radius, {palette::lesion, 1.8});
  if (name.empty()) return;
  picture_.text({p.x() + radius + 4, p.y() + 3}, name, kSmall,
                on_image ? palette::paper : palette::lesion, Anchor::start, true, on_image);
}

void Panel::nipple_triangle(const Eigen::Vector3d& x) {
  const Eigen::Vector2d p = at(x);
  const Picture::Points triangle = {{p.x(), p.y() - kMark},
                                    {p.x() + kMark, p.y() + kMark * 0.8},
                                    {p.x() - kMark, p.y() + kMark * 0.8}};
  picture_.outline(triangle, {palette::dark_edge, 4 * kEdge});
  picture_.outline(triangle, {palette::light_edge, 2 * kEdge});
  picture_.polygon(triangle, palette::nipple);
}

void Panel::nipple_mark(const Eigen::Vector3d& x, bool on_image) {
  nipple_triangle(x);
  const Eigen::Vector2d p = at(x);
  picture_.text({p.x(), p.y() - kMark - 4}, "nipple", kSmall,
                on_image ? palette::paper : palette::nipple, Anchor::middle, false, on_image);
}

void Panel::baseline_mark(const Eigen::Vector3d& x) {
  const Eigen::Vector2d p = at(x);
  picture_.cross(p, kMark, {palette::dark_edge, 1.8 + 4 * kEdge});
  picture_.cross(p, kMark, {palette::light_edge, 1.8 + 2 * kEdge});
  picture_.cross(p, kMark, {palette::baseline, 1.8});
}

}  // namespace mammotwin
