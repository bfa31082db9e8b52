#include "solver/contact/plate_placement.h"

#include "solver/element/face.h"
#include "solver/element/gauss.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace mammotwin {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSamples1d = 9;  // every 2 mm of a 16 mm element: flat contact is found to 0.01 mm

void check_directions(const PlateOptions& o) {
  const double error = std::abs(o.up.norm() - 1) + std::abs(o.depth.norm() - 1) +
                       std::abs(o.up.dot(o.depth));
  if (!(error < 1e-9))
    throw std::invalid_argument("plates: up and depth must be unit vectors at a right angle");
}

void check_length(const char* name, double value, double least) {
  if (!(std::isfinite(value) && value >= least))
    throw std::invalid_argument(std::string("plates: ") + name + " is " + std::to_string(value) +
                                " mm; expected at least " + std::to_string(least) + " mm");
}

Eigen::Vector3d on_face(int face, double s, double r) {
  Eigen::Vector3d xi;
  xi[face / 2] = face % 2;
  xi[face_directions(face)[0]] = s;
  xi[face_directions(face)[1]] = r;
  return xi;
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
              on_face(face, k % kSamples1d / (kSamples1d - 1.0), k / kSamples1d / (kSamples1d - 1.0)));
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
    : options_(options), elements_(mesh.mesh.elements()) {
  check_directions(options);
  check_length("rounding", options.rounding, 1e-3);
  check_length("wall_clearance", options.wall_clearance, 0);
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
    throw std::invalid_argument("the mesh has no face labelled chest_wall; the plates' edge is "
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
  if (heights(mesh.mesh.nodes()).first == kInfinity)
    throw std::invalid_argument("plates never touch: no skin lies in front of their edge, " +
                                std::to_string(options.wall_clearance + options.rounding) +
                                " mm before the chest wall");
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
  std::pair<double, double> range{kInfinity, -kInfinity};
  for (const auto& point : outer_points(x)) {
    if (options_.depth.dot(point) < edge_ + options_.rounding) continue;
    const double height = options_.up.dot(point);
    range = {std::min(range.first, height), std::max(range.second, height)};
  }
  return range;
}

double PlateFrame::extent(const std::vector<HermiteMesh::Node>& x) const {
  const auto [low, high] = heights(x);
  return high - low;
}

PlacedPlates PlateFrame::place(double support_height, double paddle_height) const {
  const Eigen::Vector3d front = (edge_ + options_.rounding) * options_.depth +
                                lateral_middle_ * options_.depth.cross(options_.up);
  PlacedPlates placed;
  placed.support = {front + support_height * options_.up, options_.up, options_.depth,
                    options_.rounding, false};
  placed.paddle = {front + paddle_height * options_.up, -options_.up, options_.depth,
                   options_.rounding, false};
  placed.edge = edge_;
  placed.support_height = support_height;
  placed.paddle_height = paddle_height;
  placed.lateral_middle = lateral_middle_;
  return placed;
}

double free_thickness(const MeshFile& mesh, const PlateOptions& options) {
  return PlateFrame(mesh, options).extent(mesh.mesh.nodes());
}

}  // namespace mammotwin
