#include "solver/gravity/pressing_springs.h"

#include "solver/element/element_coefficients.h"

namespace mammotwin {
namespace {

constexpr double kMilliNewton = 1e-3;

/// Energy of the springs as a function of X: what they do to x is its gradient, reversed.
class Springs : public SurfacePotential {
 public:
  Springs(const std::vector<PressedSkin::Point>& points, double k, double way_mm)
      : points_(points), k_(k), way_mm_(way_mm) {}
  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override {
    const PressedSkin::Point& here = points_[point.index];
    const double k = k_ * here.share;
    if (k == 0) return false;
    const double short_by = way_mm_ * here.way - here.outward.dot(y.head<3>() - point.X);
    response.energy = k / 2 * short_by * short_by;
    response.gradient.head<3>() = -k * short_by * here.outward;
    if (order == 2)
      response.hessian.topLeftCorner<3, 3>() = k * here.outward * here.outward.transpose();
    return true;
  }

 private:
  const std::vector<PressedSkin::Point>& points_;
  double k_, way_mm_;
};

}  // namespace

PressingSprings::PressingSprings(const BreastProblem& problem, double k) : k_(k) {
  constexpr int points1d = 8;  // a plate ends within faces
  const HermiteMesh& mesh = problem.mesh.mesh;
  faces_of_.resize(mesh.num_elements());
  if (!problem.pressed) return;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face) {
      if (problem.mesh.faces[e][face] != FaceLabel::skin) continue;
      Face imaged(e, face, element_coefficients(mesh, mesh.nodes(), e), points1d,
                  static_cast<int>(points_.size()));
      std::vector<PressedSkin::Point> points;
      bool pressed = false;
      for (int q = 0; q < imaged.num_points(); ++q) {
        points.push_back(problem.pressed.at(imaged.point(q).X, imaged.point(q).normal));
        pressed = pressed || points.back().share > 0;
      }
      if (!pressed) continue;
      points_.insert(points_.end(), points.begin(), points.end());
      faces_of_[e].push_back(static_cast<int>(faces_.size()));
      faces_.push_back(std::move(imaged));
    }
}

void PressingSprings::add(int e, const SolidElement::Coefficients& X, double way_mm,
                          ElementSystem* forward, ReferenceSystem* reference) const {
  const Springs springs(points_, k_, way_mm);
  for (const int f : faces_of_[e]) {
    ElementSystem system;
    system.residual.setZero();
    if (reference) system.tangent.setZero();
    faces_[f].add(springs, X, reference ? TangentKind::exact : TangentKind::none, system);
    if (forward) forward->residual -= system.residual;
    if (reference)
      reference->tangent -= Eigen::MatrixXd(system.tangent.selfadjointView<Eigen::Lower>());
  }
}

DeadForces PressingSprings::forces(const HermiteMesh& unloaded, double way_mm) const {
  DeadForces forces(unloaded.num_elements(), SolidElement::Coefficients::Zero());
  for (int e = 0; e < unloaded.num_elements(); ++e) {
    if (faces_of_[e].empty()) continue;
    ElementSystem system;
    system.residual.setZero();
    add(e, element_coefficients(unloaded, unloaded.nodes(), e), way_mm, &system, nullptr);
    forces[e] = -system.residual.reshaped(kFunctions, 3);
  }
  return forces;
}

double PressingSprings::force_N(const HermiteMesh& unloaded, double way_mm) const {
  double both = 0;  // [mN]
  for (const Face& face : faces_) {
    const SolidElement::Coefficients X =
        element_coefficients(unloaded, unloaded.nodes(), face.element());
    for (int q = 0; q < face.num_points(); ++q) {
      const SurfacePoint& point = face.point(q);
      const PressedSkin::Point& here = points_[point.index];
      both += k_ * here.share * point.area *
              (way_mm * here.way - here.outward.dot(face.deformed(X, q).head<3>() - point.X));
    }
  }
  return kMilliNewton * both / 2;
}

}  // namespace mammotwin
