#include "solver/contact/contact_figures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mammotwin {

namespace {

constexpr double kTouching = 0.1;  // [mm] a face wobbles by less about a plate that it lies on

void add_face(const Face& face, const SolidElement::Coefficients& x, const PlateContact& contact,
              int plate, const PlateFriction* friction, ContactFigures& figures) {
  for (int q = 0; q < face.num_points(); ++q) {
    const auto y = face.deformed(x, q);
    const Gap gap = contact.plates[plate].gap(y.head<3>());
    const SurfacePoint& point = face.point(q);
    if (gap.gap >= kTouching && contact.pressure(gap.gap) == 0) continue;
    const double stretch =
        y.segment<3>(3).cross(y.segment<3>(6)).norm() / point.A1.cross(point.A2).norm();
    const double load = contact.pressure(gap.gap) * point.area;
    Eigen::Vector3d force = load * gap.normal;
    figures.load += load;
    figures.mean_gap += load * std::abs(gap.gap);
    if (friction) force += point.area * friction->traction(y.head<3>(), point, plate);
    figures.force += force;
    figures.moment += y.head<3>().cross(force);
    if (gap.gap < kTouching) figures.area += stretch * point.area;
    figures.penetration = std::max(figures.penetration, -gap.gap);
  }
}

}  // namespace

ContactFigures contact_figures(const Model& model, const State& state, const PlateContact& contact,
                               int plate, const FaceList& faces, const PlateFriction* friction) {
  ContactFigures figures;
  for (const auto& [e, number] : faces) {
    const auto x = model.coefficients(state.x, e);
    for (const Face& face : model.faces(e))
      if (face.face() == number && face.points1d() == contact.points1d)
        add_face(face, x, contact, plate, friction, figures);
  }
  if (figures.load > 0) figures.mean_gap /= figures.load;
  return figures;
}

}  // namespace mammotwin
