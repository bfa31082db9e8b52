#include <algorithm>
#include <cmath>

#include "pipeline/report/drawing/palette.h"
#include "pipeline/validation/gel_cylinder/gel_cylinder_mesh.h"
#include "pipeline/validation/gel_figures.h"

namespace mammotwin {

namespace {

constexpr double kOutlineScale = 6;    // [pt/mm]
constexpr double kOutlineMargin = 26;  // [pt]
constexpr int kOutlinePieces = 12;     // of an element's edge

/// Points of faces with two reference coordinates fixed or one, in the order of another.
struct Trace {
  std::vector<Eigen::Vector3d> before, after;
};

/// Points of `faces` whose reference component `axis` is `value`, ordered by reference component
/// `along`.
Trace trace(const CylinderFigures& f, const FaceList& faces, int axis, double value, int along) {
  constexpr double on_plane = 1e-6;  // [mm]
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> points;
  for (const auto& [e, face] : faces)
    for (int i = 0; i <= kOutlinePieces; ++i)
      for (int j = 0; j <= kOutlinePieces; ++j) {
        Eigen::Vector3d xi;
        const int across = face / 2;
        xi[across] = face % 2;
        xi[(across + 1) % 3] = static_cast<double>(i) / kOutlinePieces;
        xi[(across + 2) % 3] = static_cast<double>(j) / kOutlinePieces;
        const Eigen::Vector3d X = f.before.mesh.position({e, xi});
        if (std::abs(X[axis] - value) < on_plane)
          points.push_back({X, f.after.mesh.position({e, xi})});
      }
  std::sort(points.begin(), points.end(),
            [along](const auto& a, const auto& b) { return a.first[along] < b.first[along]; });
  Trace t;
  for (const auto& [X, x] : points) {
    t.before.push_back(X);
    t.after.push_back(x);
  }
  return t;
}

/// The quarter's line mirrored into all four quadrants, as closed line around `middle`.
Picture::Points all_round(const std::vector<Eigen::Vector3d>& quarter, int across, int up,
                          const Eigen::Vector2d& middle) {
  Picture::Points points;
  const int n = static_cast<int>(quarter.size());
  const double signs[4][2] = {{1, -1}, {-1, -1}, {-1, 1}, {1, 1}};  // y of the picture points down
  for (int q = 0; q < 4; ++q)
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector3d& x = quarter[q % 2 == 0 ? k : n - 1 - k];
      points.push_back(middle + kOutlineScale *
                                    Eigen::Vector2d(signs[q][0] * x[across], signs[q][1] * x[up]));
    }
  return points;
}

/// The end face's edge seen from the side, continued along the flat top to the middle.
std::vector<Eigen::Vector3d> with_top(std::vector<Eigen::Vector3d> end) {
  Eigen::Vector3d top = end.back();
  top.z() = 0;
  end.push_back(top);
  return end;
}

void draw(Picture& picture, const Trace& t, int across, int up, const Eigen::Vector2d& middle,
          const Colour& colour) {
  picture.outline(all_round(t.before, across, up, middle), {palette::quiet, 1.2, {4, 3}});
  picture.polygon(all_round(t.after, across, up, middle), palette::with_alpha(colour, 0.15));
  picture.outline(all_round(t.after, across, up, middle), {colour, 1.8});
}

void draw_plates(Picture& picture, const Eigen::Vector2d& middle, double half_width,
                 double thickness) {
  constexpr double plate = 3;  // [mm] drawn
  for (double side : {-1.0, 1.0}) {
    const double y = side < 0 ? -thickness / 2 - plate : thickness / 2;
    picture.rectangle(middle.x() - half_width * kOutlineScale, middle.y() + y * kOutlineScale,
                      2 * half_width * kOutlineScale, plate * kOutlineScale, palette::grid);
  }
}

}  // namespace

Picture outline_picture(const GelResult& r) {
  const CylinderFigures& f = r.figures;
  const CylinderExperiment& x = r.experiment.experiment;
  const double end = x.length / 2;
  const FaceList mantle = faces_with_label(f.before, FaceLabel::skin);
  const FaceList ends = faces_in_plane(f.before.mesh, 2, end);
  const Trace middle = trace(f, mantle, 2, 0, 1), rim = trace(f, mantle, 2, end, 1);
  Trace side = trace(f, ends, 0, 0, 1);
  side = {with_top(side.before), with_top(side.after)};
  const double half_width = 1.15 * f.half_width_end_mm, half_length = 1.12 * side.after.front().z();
  const double height = 2 * (kOutlineMargin + 10) + x.diameter * kOutlineScale;
  Picture picture(4 * kOutlineMargin + 2 * (half_width + half_length) * kOutlineScale, height + 20);
  picture.rectangle(0, 0, picture.width(), picture.height(), palette::paper);
  const Eigen::Vector2d left(kOutlineMargin + half_width * kOutlineScale, height / 2 + 10);
  const Eigen::Vector2d right(picture.width() - kOutlineMargin - half_length * kOutlineScale,
                              height / 2 + 10);
  draw_plates(picture, left, half_width, x.thickness);
  draw_plates(picture, right, half_length, x.thickness);
  draw(picture, rim, 0, 1, left, palette::lesion);
  draw(picture, middle, 0, 1, left, palette::nipple);
  draw(picture, side, 2, 1, right, palette::nipple);
  picture.text({kOutlineMargin, 16}, "along the axis: middle (blue), end (red); dashed: before", 10,
               palette::ink);
  picture.text({right.x() - half_length * kOutlineScale, 16}, "from the side", 10, palette::ink);
  return picture;
}

}  // namespace mammotwin
