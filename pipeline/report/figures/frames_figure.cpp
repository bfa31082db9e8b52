#include "pipeline/report/figures/frames_figure.h"

#include <cmath>
#include <numbers>

#include "pipeline/report/drawing/palette.h"
#include "registration/view/detector.h"
#include "registration/view/view_frame.h"

namespace mammotwin {
namespace {

constexpr double kText = 9;  // [pt]

void arrow(Picture& picture, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
           const Colour& colour, const std::string& name = "") {
  const Eigen::Vector2d along = (to - from).normalized(), across(-along.y(), along.x());
  constexpr double kHead = 6;
  picture.line({from, to - 0.7 * kHead * along}, {colour, 1.5});
  picture.polygon(
      {to, to - kHead * along + 0.45 * kHead * across, to - kHead * along - 0.45 * kHead * across},
      colour);
  if (!name.empty())
    picture.text(to + 7 * along + Eigen::Vector2d(0, 3), name, kText, colour,
                 along.x() < -0.3  ? Anchor::end
                 : along.x() > 0.3 ? Anchor::start
                                   : Anchor::middle,
                 true);
}

void heading(Picture& picture, double x, const std::string& title, const std::string& below) {
  picture.text({x, 14}, title, 10.5, palette::ink, Anchor::start, true);
  picture.text({x, 28}, below, 8.5, palette::quiet);
}

/// LPS x and z on paper, facing the patient: her left is to the right.
Eigen::Vector2d coronal(const Eigen::Vector2d& centre, const Eigen::Vector3d& x) {
  return centre + Eigen::Vector2d(x.x(), -x.z());
}

/// One breast from the front with the support, the beam and the axes of a view.
void draw_view(Picture& picture, const Eigen::Vector2d& centre, Side side, double angle_deg) {
  const Eigen::Matrix3d axes = view_axes(side, angle_deg);
  const Eigen::Vector3d lateral = axes.row(1), height = axes.row(2);
  const auto at = [&](double l, double h) -> Eigen::Vector2d {
    return coronal(centre, l * lateral + h * height);
  };
  constexpr double kHalf = 44, kLow = -30;
  picture.circle(centre, 26, {palette::skin, 2});
  picture.disc(centre, 2.5, palette::nipple);
  picture.line({at(-kHalf, kLow), at(kHalf, kLow)}, {palette::plate, 4});
  arrow(picture, at(-kHalf + 6, 52), at(-kHalf + 6, kLow + 6), palette::ink);
  arrow(picture, at(0, kLow), at(52, kLow), palette::lesion, "lateral");
  arrow(picture, at(0, kLow), at(0, 44), palette::nipple, "height");
  picture.text(centre + Eigen::Vector2d(0, 86),
               std::string(side == Side::left ? "left " : "right ") +
                   (angle_deg == 0 ? "CC" : "MLO 45\u00b0"),
               kText, palette::ink, Anchor::middle, true);
}

void draw_patient(Picture& picture, double x) {
  heading(picture, x, "LPS and view axes, facing the patient",
          "depth points at you; orange: beam, from superior-medial when oblique");
  const double right = x + 70, left = x + 240;
  draw_view(picture, {right, 110}, Side::right, 0);
  draw_view(picture, {left, 110}, Side::left, 0);
  draw_view(picture, {right, 285}, Side::right, 45);
  draw_view(picture, {left, 285}, Side::left, 45);
  const Eigen::Vector2d corner(x + 155, 205);
  arrow(picture, corner, corner + Eigen::Vector2d(26, 0), palette::ink, "L");
  arrow(picture, corner, corner + Eigen::Vector2d(0, -26), palette::ink, "S");
}

void draw_beam(Picture& picture, double x) {
  heading(picture, x, "View and detector, seen along the edge",
          "u = depth D / (D \u2212 gap \u2212 height), v likewise from lateral");
  Detector detector;
  detector.source_distance_mm = 250;  // near, so that the cone shows
  detector.support_gap_mm = 22;
  const Eigen::Vector2d foot(x + 40, 330);  // detector plane under the edge
  const auto at = [&](double depth, double height) -> Eigen::Vector2d {
    return foot + Eigen::Vector2d(depth, -(height + detector.support_gap_mm));
  };
  const Eigen::Vector3d point(105, 0, 48);
  const double u = detector.project(point).x();
  const Eigen::Vector3d source = detector.source_in_view();
  picture.line({at(0, -22), at(190, -22)}, {palette::ink, 2.5});
  picture.text(at(192, -22) + Eigen::Vector2d(4, 3), "detector", kText, palette::ink);
  picture.rectangle(at(0, 0).x(), at(0, 0).y(), 190, 4, palette::plate);
  picture.rectangle(at(0, 84).x(), at(0, 84).y() - 4, 190, 4, palette::plate);
  picture.text(at(192, 0) + Eigen::Vector2d(4, 3), "support", kText, palette::quiet);
  picture.text(at(192, 84) + Eigen::Vector2d(4, 3), "paddle", kText, palette::quiet);
  Picture::Points skin = {at(-22, 84)};
  for (int i = 0; i <= 24; ++i) {
    const double a = std::numbers::pi * (0.5 - i / 24.0);
    skin.push_back(at(120 + 42 * std::cos(a), 42 + 42 * std::sin(a)));
  }
  skin.push_back(at(-22, 0));
  picture.line(skin, {palette::skin, 2});
  picture.line({at(source.x(), source.z()), at(u, -22)}, {palette::ink, 1.2, {4, 3}});
  picture.line({at(0, source.z()), at(0, -22)}, {palette::ink, 1.2, {4, 3}});
  picture.disc(at(0, source.z()), 4, palette::ink);
  picture.text(at(0, source.z()) + Eigen::Vector2d(8, 3),
               "source, D above the detector, over the edge", kText, palette::ink);
  picture.disc(at(point.x(), point.z()), 4, palette::lesion);
  arrow(picture, at(0, 0), at(62, 0), palette::lesion, "depth");
  arrow(picture, at(0, 0), at(0, 62), palette::nipple, "height");
  picture.text(at(-6, -11) + Eigen::Vector2d(0, 3), "gap", 8, palette::quiet, Anchor::end);
  picture.line({at(u, -22), at(u, -30)}, {palette::lesion, 1.5});
  picture.text(at(u, -22) + Eigen::Vector2d(0, 20), "u", kText, palette::lesion, Anchor::middle,
               true);
  picture.text(at(-24, 96), "chest wall", 8, palette::quiet, Anchor::middle);
}

void draw_pixels(Picture& picture, double x) {
  heading(picture, x, "Detector [mm] and pixels",
          "columns from the chest wall, rows down, lateral up");
  constexpr double kPixel = 24;
  Detector detector;
  detector.pixels = PixelGrid{kPixel, 7, 11, ImageEdge::left, true};
  const double top = 50;
  const Eigen::Vector2d first(x + 20 + kPixel / 2, top + kPixel / 2);  // centre of pixel (0, 0)
  const auto at = [&](const Eigen::Vector2d& uv) {
    return (first + kPixel * detector.image_from_detector(uv)).eval();
  };
  for (int i = 0; i <= 7; ++i)
    picture.line({{x + 20 + i * kPixel, top}, {x + 20 + i * kPixel, top + 11 * kPixel}},
                 {palette::grid, 0.8});
  for (int j = 0; j <= 11; ++j)
    picture.line({{x + 20, top + j * kPixel}, {x + 20 + 7 * kPixel, top + j * kPixel}},
                 {palette::grid, 0.8});
  picture.line({at({0, -5.5 * kPixel}), at({0, 5.5 * kPixel})}, {palette::plate, 3});
  Picture::Points outline;
  for (int i = 0; i <= 30; ++i) {
    const double a = std::numbers::pi * (i / 30.0 - 0.5);
    outline.push_back(at({135 * std::cos(a), 108 * std::sin(a)}));
  }
  picture.line(outline, {palette::skin, 2});
  arrow(picture, at({0, 0}), at({60, 0}), palette::lesion, "u");
  arrow(picture, at({0, 0}), at({0, 60}), palette::nipple, "v");
  const Eigen::Vector2d lesion = at({86, 44});
  picture.disc(lesion, 4, palette::lesion);
  picture.disc(first, 2.5, palette::ink);
  picture.text(first + Eigen::Vector2d(6, 3), "(0, 0)", 8, palette::ink);
  arrow(picture, {x + 20, top - 7}, {x + 70, top - 7}, palette::ink, "column");
  arrow(picture, {x + 10, top}, {x + 10, top + 50}, palette::ink, "row");
  picture.text(at({0, -5.5 * kPixel}) + Eigen::Vector2d(0, 16),
               "chest-wall edge, here at the image's left", 8, palette::plate);
}

}  // namespace

Figure frames_figure() {
  Picture picture(960, 400);
  picture.rectangle(0, 0, picture.width(), picture.height(), palette::paper);
  draw_patient(picture, 30);
  draw_beam(picture, 385);
  draw_pixels(picture, 700);
  return {
      picture, "The frames in which positions are given.",
      "Three sketches: the axes lateral and height of CC and MLO views of both breasts, facing the "
      "patient; the cone beam from source through the breast to the detector; detector "
      "millimetres and pixels."};
}

}  // namespace mammotwin
