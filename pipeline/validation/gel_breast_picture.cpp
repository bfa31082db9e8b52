#include "pipeline/validation/gel_breast_picture.h"

#include <Eigen/Geometry>
#include <cmath>

#include "pipeline/report/drawing/palette.h"

namespace mammotwin {
namespace {

constexpr double kScale = 2.2;  // [pt/mm]
constexpr double kMargin = 26;  // [pt]
constexpr int kPieces = 12;     // of an element's edge
constexpr int kEvery = 4;       // of the scan's points

/// The patient's left side, tip to the left, head up; y downwards as pictures have it.
Eigen::Vector2d seen(const Eigen::Vector3d& x) { return {x.y(), -x.z()}; }

bool faces_the_eye(const HermiteMesh& mesh, const MeshPoint& p) {
  const Eigen::Matrix3d F = mesh.jacobian(p);
  return F.col(0).cross(F.col(1)).x() > 0;
}

/// The parts of a skin face's edge that are on the near side.
void draw_edge(Picture& picture, const HermiteMesh& mesh, int element, int edge,
               const Eigen::Vector2d& origin) {
  Picture::Points line;
  const auto finish = [&] {
    if (line.size() > 1) picture.line(line, {palette::nipple, 1.1});
    line.clear();
  };
  for (int p = 0; p <= kPieces; ++p) {
    Eigen::Vector3d xi(static_cast<double>(p) / kPieces, edge % 2, 1);
    if (edge >= 2) std::swap(xi.x(), xi.y());
    const MeshPoint point{element, xi};
    if (!faces_the_eye(mesh, point)) {
      finish();
      continue;
    }
    line.push_back(origin + kScale * seen(mesh.position(point)));
  }
  finish();
}

void draw(Picture& picture, const GelBreastState& state, const Eigen::Vector2d& origin) {
  for (std::size_t i = 0; i < state.scan.size(); i += kEvery)
    if (state.scan[i].x() > 0)
      picture.disc(origin + kScale * seen(state.scan[i]), 0.75,
                   palette::with_alpha(palette::lesion, 0.55));
  for (int e = 0; e < state.mesh.mesh.num_elements(); ++e)
    if (state.mesh.faces[e][5] == FaceLabel::skin)
      for (int edge = 0; edge < 4; ++edge) draw_edge(picture, state.mesh.mesh, e, edge, origin);
}

std::string title_of(const GelBreastState& state) {
  if (state.compressed_fraction == 0) return "as scanned";
  return "CC, " + std::to_string(std::lround(100 * state.compressed_fraction)) + " %";
}

}  // namespace

Picture gel_breast_picture(const GelBreastResult& result) {
  Eigen::AlignedBox2d box;
  for (const GelBreastState& s : result.states)
    for (const Eigen::Vector3d& x : s.scan) box.extend(seen(x));
  const Eigen::Vector2d size = kScale * box.sizes();
  const double panel = size.x() + kMargin;
  Picture picture(kMargin + panel * static_cast<double>(result.states.size()),
                  size.y() + 2 * kMargin);
  picture.rectangle(0, 0, picture.width(), picture.height(), palette::paper);
  double left = kMargin;
  for (const GelBreastState& s : result.states) {
    draw(picture, s, Eigen::Vector2d(left, kMargin) - kScale * box.min());
    picture.text({left, 16}, title_of(s), 11, palette::ink);
    left += panel;
  }
  return picture;
}

}  // namespace mammotwin
