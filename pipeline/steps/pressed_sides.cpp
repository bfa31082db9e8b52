#include "pipeline/steps/pressed_sides.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/steps/breast_reach.h"
#include "pipeline/steps/skin_samples.h"
#include "solver/element/face.h"

namespace mammotwin {
namespace {

constexpr int kSkinSamples = 6;  // of a face along each of its sides
const Eigen::Vector3d kForward = -Eigen::Vector3d::UnitY(), kHeadward = Eigen::Vector3d::UnitZ();

/// Cosines of a normal to its side: none of it is pressed from the first on, all from the second.
constexpr double kNotPressed = 0.7, kPressed = 0.9;
constexpr double kBeyondSpread = 1.2;  // ellipse over that of the same moments
constexpr double kRearRim_mm = 10;     // before the wall: there it begins

double facing(double cosine) {
  return std::clamp((cosine - kNotPressed) / (kPressed - kNotPressed), 0.0, 1.0);
}

/// Pressed skin of one side, in the plane of its forward and headward directions.
struct PressedEllipse {
  Eigen::Vector3d outward;
  double wall;  ///< foremost of it [mm forward]
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();  ///< of its quadratic form

  static Eigen::Vector2d flat(const Eigen::Vector3d& x) {
    return {kForward.dot(x), kHeadward.dot(x)};
  }
  /// 1 in the middle, 0 at the rim, beyond it and behind the wall.
  double at(const Eigen::Vector3d& x) const {
    const Eigen::Vector2d off = flat(x) - middle;
    const double before = std::clamp((kForward.dot(x) - wall) / kRearRim_mm, 0.0, 1.0);
    return before * std::max(0.0, 1 - off.dot(inverse * off));
  }
};

PressedEllipse pressed_ellipse(const std::vector<SkinSample>& skin, const Eigen::Vector3d& outward,
                               double wall) {
  PressedEllipse ellipse{outward, wall};
  double area = 0;
  const auto weight = [&](const SkinSample& s) {
    return kForward.dot(s.x) > wall ? s.area * facing(outward.dot(s.outward)) : 0;
  };
  for (const SkinSample& s : skin) {
    area += weight(s);
    ellipse.middle += weight(s) * PressedEllipse::flat(s.x);
  }
  if (area == 0) return ellipse;
  ellipse.middle /= area;
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const SkinSample& s : skin) {
    const Eigen::Vector2d off = PressedEllipse::flat(s.x) - ellipse.middle;
    moments += weight(s) / area * off * off.transpose();
  }
  const double half_axis = 2 * kBeyondSpread;  // a uniform ellipse reaches to two deviations
  ellipse.inverse = (half_axis * half_axis * moments).inverse();
  return ellipse;
}

/// The horizontal direction to whose two sides most skin before the wall faces: of a flat breast
/// that of its sides, however the body is turned. What faces one side only counts for nothing, for
/// plates come in pairs, and on a shallow breast it is the slope beside the nipple.
Eigen::Vector3d facing_direction(const MeshFile& imaged) {
  constexpr int most_deg = 45;  // off from side to side
  constexpr int sharpness = 8;  // skin 24 degrees off counts half
  const double wall = breast_reach(imaged, kForward).wall;
  const std::vector<SkinSample> skin = skin_samples(imaged, kSkinSamples);
  const auto at = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  };
  const auto both_sides = [&](int degrees) {
    double sides[] = {0, 0};
    for (const SkinSample& s : skin) {
      const double cosine = at(degrees).dot(s.outward);
      if (kForward.dot(s.x) > wall) sides[cosine > 0] += s.area * std::pow(cosine, sharpness);
    }
    return sides[0] * sides[1];
  };
  int best = 0;
  double most = 0;
  for (int k = 0; k <= 2 * most_deg; ++k) {
    const int degrees = (k + 1) / 2 * (k % 2 == 0 ? 1 : -1);  // from the middle to either side
    const double here = both_sides(degrees);
    if (here > most) best = degrees, most = here;
  }
  if (most == 0 || std::abs(best) == most_deg) return Eigen::Vector3d::UnitX();
  const double before = both_sides(best - 1), after = both_sides(best + 1);
  return at(best + 0.5 * (before - after) / (before - 2 * most + after));
}

}  // namespace

Roundness::Roundness(const MeshFile& imaged, const Eigen::Vector3d& across)
    : elements_(imaged.mesh.elements()), across_(across) {
  constexpr int n = 6;
  const double tip = breast_reach(imaged, kForward).tip;
  double wall = 0;  // in the mean
  int faces = 0;
  for (int e = 0; e < imaged.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      if (imaged.faces[e][face] == FaceLabel::chest_wall) {
        wall += kForward.dot(imaged.mesh.position({e, point_on_face(face, 0.5, 0.5)}));
        ++faces;
      }
  const double middle = (wall / faces + tip) / 2;
  for (int e = 0; e < imaged.mesh.num_elements(); ++e)
    for (int k = 0; k < n * n * n; ++k) {
      const MeshPoint point{
          e, (Eigen::Vector3d(k % n, k / n % n, k / n / n) + Eigen::Vector3d::Constant(0.5)) / n};
      if (kForward.dot(imaged.mesh.position(point)) > middle)
        samples_.push_back({point, imaged.mesh.jacobian(point).determinant()});
    }
}

double Roundness::of(const std::vector<HermiteMesh::Node>& shape) const {
  const HermiteMesh mesh(shape, elements_);
  double volume = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = Eigen::Vector2d::Zero();
  for (const auto& [point, weight] : samples_) {
    const Eigen::Vector3d x = mesh.position(point);
    const Eigen::Vector2d here(across_.dot(x), kHeadward.dot(x));
    volume += weight;
    sum += weight * here;
    squares += weight * here.cwiseAbs2();
  }
  const Eigen::Vector2d variances = squares / volume - (sum / volume).cwiseAbs2();
  return std::sqrt(variances.x() / variances.y());
}

std::optional<PressedSides> find_pressed_sides(const MeshFile& imaged, double flat) {
  PressedSides sides;
  sides.plates = find_coil_plates(imaged);
  sides.across = sides.plates ? sides.plates->across : facing_direction(imaged);
  sides.roundness = Roundness(imaged, sides.across).of(imaged.mesh.nodes());
  if (!sides.plates && sides.roundness >= flat) return std::nullopt;
  return sides;
}

PressedSkin pressed_skin(const MeshFile& imaged, const PressedSides& sides) {
  const std::vector<SkinSample> skin = skin_samples(imaged, kSkinSamples);
  const double wall = breast_reach(imaged, kForward).wall;
  const std::array<PressedEllipse, 2> ellipses{pressed_ellipse(skin, sides.across, wall),
                                               pressed_ellipse(skin, -sides.across, wall)};
  PressedSkin pressed;
  pressed.at = [ellipses](const Eigen::Vector3d& x, const Eigen::Vector3d& normal) {
    PressedSkin::Point point;
    for (const PressedEllipse& ellipse : ellipses) {
      const double here = ellipse.at(x), towards = facing(ellipse.outward.dot(normal));
      if (here > 0 && towards > 0)
        point = {std::cbrt(here) * towards, ellipse.outward, here};  // stiff to near the rim
    }
    return point;
  };
  return pressed;
}

}  // namespace mammotwin
