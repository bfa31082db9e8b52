#include "pipeline/report/panel.h"

#include <algorithm>

#include "pipeline/report/palette.h"

namespace mammotwin {
namespace {

constexpr double kSmall = 8;   // [pt] text beside marks
constexpr double kMark = 4.5;  // [pt] half size of a cross or triangle

}  // namespace

void Panel::pieces(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pieces,
                   const Stroke& stroke) {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> on_paper;
  for (const auto& [a, b] : pieces) on_paper.emplace_back(at(a), at(b));
  picture_.clip(x_, y_, width(), height());
  picture_.segments(on_paper, stroke);
  picture_.unclip();
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

void Panel::lesion_mark(const Eigen::Vector3d& x, double radius_mm, const std::string& name,
                        bool on_image) {
  const Eigen::Vector2d p = at(x);
  const double radius = std::max(radius_mm * scale_, 4.0);
  picture_.circle(p, radius, {palette::paper, 3});
  picture_.circle(p, radius, {palette::lesion, 1.8});
  picture_.text({p.x() + radius + 3, p.y() + 3}, name, kSmall,
                on_image ? palette::paper : palette::lesion, Anchor::start, true, on_image);
}

void Panel::nipple_mark(const Eigen::Vector3d& x, bool on_image) {
  const Eigen::Vector2d p = at(x);
  const Picture::Points triangle = {{p.x(), p.y() - kMark},
                                    {p.x() + kMark, p.y() + kMark * 0.8},
                                    {p.x() - kMark, p.y() + kMark * 0.8}};
  picture_.polygon(triangle, palette::nipple);
  picture_.outline(triangle, {palette::paper, 1});
  picture_.text({p.x(), p.y() - kMark - 3}, "nipple", kSmall,
                on_image ? palette::paper : palette::nipple, Anchor::middle, false, on_image);
}

void Panel::baseline_mark(const Eigen::Vector3d& x, const std::string& name) {
  const Eigen::Vector2d p = at(x);
  picture_.cross(p, kMark, {palette::paper, 3.5});
  picture_.cross(p, kMark, {palette::baseline, 1.8});
  if (!name.empty())
    picture_.text({p.x() - kMark - 3, p.y() + 3}, name, kSmall, palette::baseline_label,
                  Anchor::end, false, true);
}

}  // namespace mammotwin
