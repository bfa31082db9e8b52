#include "registration/carry/supine_place.h"

#include "registration/carry/point_carrier.h"
#include "registration/view/breast_position.h"

namespace mammotwin {
namespace {

constexpr double kStep_mm = 1, kExact_mm = 0.01;
constexpr double kFarthest_mm = 300;  // no breast is deeper
constexpr double kOnFace = 0.02;      // of an element, from its face

/// The last point inside on the way forward from x, and where it is in the mesh.
struct WayOut {
  Eigen::Vector3d x;
  MeshPoint last;
};

std::optional<WayOut> way_out(const InverseMap& inverse, const Eigen::Vector3d& from) {
  const Eigen::Vector3d forward(0, -1, 0);
  std::optional<MeshPoint> last = inverse.locate(from);
  if (!last) return std::nullopt;
  double in = 0, out = kStep_mm;
  for (; out < kFarthest_mm; out += kStep_mm) {
    const auto next = inverse.locate(from + out * forward, *last);
    if (!next) break;
    last = next;
    in = out;
  }
  while (out - in > kExact_mm) {
    const double middle = (in + out) / 2;
    const auto next = inverse.locate(from + middle * forward, *last);
    if (next) last = next;
    (next ? in : out) = middle;
  }
  return WayOut{from + in * forward, *last};
}

bool on_skin(const MeshPoint& point, const std::vector<FaceLabels>& faces) {
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      if (std::abs(point.xi[axis] - side) < kOnFace &&
          faces[point.element][2 * axis + side] == FaceLabel::skin)
        return true;
  return false;
}

}  // namespace

Eigen::Vector3d supine_semi_axes_mm(const Eigen::Vector3d& lesion_in_prone,
                                    const Eigen::Vector3d& nipple_in_prone) {
  return kSupineSpreads * kSupineSpread * (lesion_in_prone - nipple_in_prone).norm();
}

std::optional<SupinePlace> supine_place(const MeshFile& prone, const HermiteMesh& supine, Side side,
                                        const Eigen::Vector3d& lesion_in_prone,
                                        const Eigen::Vector3d& nipple_in_prone) {
  const PointCarrier carrier(prone.mesh, supine);
  const Eigen::Vector3d lesion = carrier.carry(lesion_in_prone).in_lps,
                        nipple = carrier.carry(nipple_in_prone).in_lps;
  const auto out = way_out(InverseMap(supine), lesion);
  if (!out || !on_skin(out->last, prone.faces)) return std::nullopt;
  return SupinePlace{out->x,
                     (out->x - lesion).norm(),
                     breast_position(side, out->x, nipple).clock,
                     (out->x - nipple).norm(),
                     lesion,
                     supine_semi_axes_mm(lesion_in_prone, nipple_in_prone)};
}

}  // namespace mammotwin
