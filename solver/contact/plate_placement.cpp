#include "solver/contact/plate_placement.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "solver/element/face.h"
#include "solver/element/gauss.h"

namespace mammotwin {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostTilt = 30;  // [deg]
constexpr double kRadians = std::numbers::pi / 180;
constexpr int kSamples1d = 9;  // every 2 mm of a 16 mm element: flat contact is found to 0.01 mm

void check_directions(const PlateOptions& o) {
  const double error =
      std::abs(o.up.norm() - 1) + std::abs(o.depth.norm() - 1) + std::abs(o.up.dot(o.depth));
  if (!(error < 1e-9))
    throw std::invalid_argument("plates: up and depth must be unit vectors at a right angle");
}

void check_length(const char* name, double value, double least) {
  if (!(std::isfinite(value) && value >= least))
    throw std::invalid_argument(std::string("plates: ") + name + " is " + std::to_string(value) +
                                " mm; expected at least " + std::to_string(least) + " mm");
}

void check_extent(const char* name, double value, double rounding) {
  if (!(value > 2 * rounding))
    throw std::invalid_argument(std::string("plates: ") + name + " is " + std::to_string(value) +
                                " mm; expected more than the two rounded edges' " +
                                std::to_string(2 * rounding) + " mm");
}

void check_tilt(const PlateOptions& o) {
  if (!(std::abs(o.paddle_tilt) <= kMostTilt))
    throw std::invalid_argument("plates: tilt is " + std::to_string(o.paddle_tilt) +
                                " deg; expected -30 to 30 deg");
  if (!(o.tilt_spring > 0 && std::isfinite(o.pivot)))
    throw std::invalid_argument("plates: the tilt's spring must be positive, its pivot finite");
}

Eigen::Vector3d interpolate(const std::vector<HermiteMesh::Node>& x,
                            const HermiteMesh::Corners& corners, const HermiteMesh::Weights& w) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int n = 0; n < 8; ++n) sum += x[corners[n]] * w.row(n).transpose();
  return sum;
}

template <class Visit>
void for_face_samples(const MeshFile& mesh, Visit visit) {
  for (int e = 0; e < mesh.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      for (int k = 0; k < kSamples1d * kSamples1d; ++k)
        visit(e, mesh.faces[e][face],
              point_on_face(face, k % kSamples1d / (kSamples1d - 1.0),
                            k / kSamples1d / (kSamples1d - 1.0)));
}

Eigen::Vector3d volume_centroid(const HermiteMesh& mesh) {
  const auto rule = gauss_rule(4);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double volume = 0;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int q = 0; q < 64; ++q) {
      const int i = q & 3, j = q >> 2 & 3, k = q >> 4;
      const MeshPoint p{e, {rule.points[i], rule.points[j], rule.points[k]}};
      const double w =
          rule.weights[i] * rule.weights[j] * rule.weights[k] * mesh.jacobian(p).determinant();
      volume += w;
      moment += w * mesh.position(p);
    }
  return moment / volume;
}

}  // namespace

PlateFrame::PlateFrame(const MeshFile& mesh, const PlateOptions& options)
    : options_(options), elements_(mesh.mesh.elements()), reference_(mesh.mesh.nodes()) {
  check_directions(options);
  check_length("rounding", options.rounding, 1e-3);
  check_length("wall_clearance", options.wall_clearance, 0);
  check_extent("width", options.width, options.rounding);
  check_extent("length", options.length, options.rounding);
  check_tilt(options);
  const Eigen::Vector3d lateral = options.depth.cross(options.up);
  double wall = -kInfinity, left = kInfinity, right = -kInfinity;
  for_face_samples(mesh, [&](int e, FaceLabel label, const Eigen::Vector3d& xi) {
    if (label == FaceLabel::interior) return;
    const Eigen::Vector3d x = mesh.mesh.position({e, xi});
    if (label == FaceLabel::chest_wall) {
      wall = std::max(wall, options.depth.dot(x));
      return;
    }
    outer_.push_back({e, HermiteMesh::weights(xi)});
    left = std::min(left, lateral.dot(x));
    right = std::max(right, lateral.dot(x));
  });
  if (wall == -kInfinity)
    throw std::invalid_argument(
        "the mesh has no face labelled chest_wall; the plates' edge is "
        "placed by it");
  edge_ = wall + options.wall_clearance;
  lateral_middle_ = (left + right) / 2;
  centroid_height_ = options.up.dot(volume_centroid(mesh.mesh));
  touching_ = {kInfinity, -kInfinity};
  for (const auto& x : outer_points(mesh.mesh.nodes())) {
    if (options.depth.dot(x) < edge_) continue;
    touching_.first = std::min(touching_.first, options.up.dot(x));
    touching_.second = std::max(touching_.second, options.up.dot(x));
  }
  find_flat_part();
  touching_ = {touching_height(false, touching_.first, touching_.second),
               touching_height(true, touching_.first, touching_.second)};
  if (heights(mesh.mesh.nodes()).first == kInfinity)
    throw std::invalid_argument(
        "plates never touch: no skin lies between their flat parts, which begin " +
        std::to_string(options.wall_clearance + options.rounding) + " mm before the chest wall");
}

std::vector<Eigen::Vector3d> PlateFrame::outer_points(
    const std::vector<HermiteMesh::Node>& x) const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(outer_.size());
  for (const auto& [element, weights] : outer_)
    points.push_back(interpolate(x, elements_[element], weights));
  return points;
}

std::pair<double, double> PlateFrame::heights(const std::vector<HermiteMesh::Node>& x) const {
  const auto points = outer_points(x);
  std::pair<double, double> range{kInfinity, -kInfinity};
  const auto count = [&](const Eigen::Vector3d& point) {
    const double height = options_.up.dot(point);
    range = {std::min(range.first, height), std::max(range.second, height)};
  };
  const auto count_crossing = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    if (over_flat_part(a) != over_flat_part(b)) count(border_between(a, b));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (over_flat_part(points[i])) count(points[i]);
    const int column = i % kSamples1d, row = i / kSamples1d % kSamples1d;
    if (column + 1 < kSamples1d) count_crossing(points[i], points[i + 1]);
    if (row + 1 < kSamples1d) count_crossing(points[i], points[i + kSamples1d]);
  }
  return range;
}

/// Where the line from one to the other passes the border of the flat part: with it the extent is
/// continuous in the shape.
Eigen::Vector3d PlateFrame::border_between(Eigen::Vector3d a, Eigen::Vector3d b) const {
  constexpr int halvings = 30;
  if (!over_flat_part(a)) std::swap(a, b);
  for (int k = 0; k < halvings; ++k) {
    const Eigen::Vector3d middle = (a + b) / 2;
    (over_flat_part(middle) ? a : b) = middle;
  }
  return a;
}

double PlateFrame::extent(const std::vector<HermiteMesh::Node>& x) const {
  const auto [low, high] = heights(x);
  return high - low;
}

double PlateFrame::volume_in_front() const {
  return mammotwin::volume_in_front(HermiteMesh(reference_, elements_), options_.depth, edge_);
}

void PlateFrame::find_flat_part() {
  const double r = options_.rounding;
  flat_ = {edge_ + r, edge_ + options_.length - r, lateral_middle_ - options_.width / 2 + r,
           lateral_middle_ + options_.width / 2 - r};
  for (const bool paddle : {false, true})
    if (const auto& mesh = paddle ? options_.paddle_mesh : options_.support_mesh) {
      // Sideways on the support runs against depth x up.
      const double left = paddle ? mesh->low().y() : -mesh->high().y();
      const double right = paddle ? mesh->high().y() : -mesh->low().y();
      flat_ = {std::max(flat_.rear, edge_ + mesh->low().x()),
               std::min(flat_.front, edge_ + mesh->high().x()),
               std::max(flat_.left, lateral_middle_ + left),
               std::min(flat_.right, lateral_middle_ + right)};
    }
}

bool PlateFrame::over_flat_part(const Eigen::Vector3d& x) const {
  const double along = options_.depth.dot(x);
  const double across = options_.depth.cross(options_.up).dot(x);
  return along >= flat_.rear && along <= flat_.front && across >= flat_.left &&
         across <= flat_.right;
}

/// Where a plate just touches a breast that reaches from low to high in front of the edge.
double PlateFrame::touching_height(bool paddle, double low, double high) const {
  const bool level =
      paddle ? options_.paddle_tilt == 0 && !options_.paddle_mesh : !options_.support_mesh;
  if (level) return paddle ? high : low;
  const auto points = outer_points(reference_);
  const auto clear = [&](double height) {
    const PlacedPlates placed = place(height, height, options_.paddle_tilt);
    const Plate& plate = paddle ? placed.paddle : placed.support;
    return std::none_of(points.begin(), points.end(), [&](const Eigen::Vector3d& x) {
      return options_.depth.dot(x) >= edge_ && plate.gap(x).gap < 0;
    });
  };
  constexpr double farther = 300;  // [mm] of a tilted or bent plate's face from its own height
  double inside = paddle ? low : high, outside = paddle ? high + farther : low - farther;
  for (int halving = 0; halving < 30; ++halving)
    (clear((inside + outside) / 2) ? outside : inside) = (inside + outside) / 2;
  return outside;
}

PlacedPlates PlateFrame::place(double support_height, double paddle_height, double tilt) const {
  const Eigen::Vector3d& up = options_.up;
  const Eigen::Vector3d& depth = options_.depth;
  const double c = std::cos(kRadians * tilt), s = std::sin(kRadians * tilt);
  const auto plate = [&](double height, const Eigen::Vector3d& normal, const Eigen::Vector3d& along,
                         const std::shared_ptr<const PlateMesh>& mesh) {
    const double start = mesh ? 0 : options_.rounding;  // facets count from the edge
    const Eigen::Vector3d point =
        (edge_ + start) * depth + lateral_middle_ * depth.cross(up) + height * up;
    return Plate{point,
                 normal,
                 along,
                 options_.rounding,
                 false,
                 options_.width / 2 - options_.rounding,
                 options_.length - 2 * options_.rounding,
                 mesh};
  };
  PlacedPlates placed;
  placed.support = plate(support_height, up, depth, options_.support_mesh);
  placed.paddle = tilt == 0 ? plate(paddle_height, -up, depth, options_.paddle_mesh)
                            : plate(paddle_height, -c * up - s * depth, c * depth - s * up,
                                    options_.paddle_mesh);
  placed.paddle_tilt = tilt;
  placed.edge = edge_;
  placed.support_height = support_height;
  placed.paddle_height = paddle_height;
  placed.lateral_middle = lateral_middle_;
  return placed;
}

double volume_in_front(const HermiteMesh& mesh, const Eigen::Vector3d& depth, double edge) {
  constexpr int samples = 12;  // of an element along each axis, each standing for its surroundings
  double volume = 0;
  for (int n = 0; n < samples * samples * samples; ++n) {
    const Eigen::Array3d cell(n % samples, n / samples % samples, n / (samples * samples));
    const Eigen::Vector3d xi = (cell + 0.5) / samples;
    const HermiteMesh::Weights weights = HermiteMesh::weights(xi);
    std::array<HermiteMesh::Weights, 3> slopes;
    for (int i = 0; i < 3; ++i) {
      std::array<int, 3> orders{};
      orders[i] = 1;
      slopes[i] = HermiteMesh::weights(xi, orders);
    }
    for (int e = 0; e < mesh.num_elements(); ++e) {
      if (depth.dot(mesh.interpolate(e, weights)) <= edge) continue;
      Eigen::Matrix3d J;
      for (int i = 0; i < 3; ++i) J.col(i) = mesh.interpolate(e, slopes[i]);
      volume += J.determinant();
    }
  }
  return volume / (samples * samples * samples);
}

double free_thickness(const MeshFile& mesh, const PlateOptions& options) {
  return PlateFrame(mesh, options).extent(mesh.mesh.nodes());
}

}  // namespace mammotwin
