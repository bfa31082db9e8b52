#include "fitting/mesh/cylinder_mesh.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mammotwin {

namespace {

using Eigen::Vector2d;

/// A point of the cross-section with its derivatives along ξ₁, ξ₂ and both.
using PlaneNode = std::array<Vector2d, 4>;

/// The ring patch at +x turned by quarter turns: which of its directions is ξ₁, and its sense.
struct Turn {
  bool radial_is_first;
  double radial, side;  ///< sign of the radial and of the anticlockwise direction
};
constexpr std::array<Turn, 4> turns = {
    {{true, 1, 1}, {false, 1, -1}, {true, -1, -1}, {false, -1, 1}}};

Vector2d turned(const Vector2d& v, int quarter) {
  Vector2d w = v;
  for (int q = 0; q < quarter; ++q) w = Vector2d(-w.y(), w.x());
  return w;
}

/// A place in [0, 1] and how fast it moves with the element coordinate.
struct Place {
  double at, rate;
};

/// Corner `i` of `n` elements whose size changes steadily by `grading` from the first to the last:
/// (q^s − 1) / (q − 1) for s = i / n, smooth in s, so a graded mesh is as C¹ as an even one.
Place graded(int i, int n, double grading) {
  const double s = static_cast<double>(i) / n, log = std::log(grading);
  if (log == 0) return {s, 1.0 / n};
  return {std::expm1(s * log) / std::expm1(log), std::exp(s * log) * log / std::expm1(log) / n};
}

/// Builds the cross-section's nodes and quads, then the solid by extrusion.
class CylinderBuilder {
 public:
  CylinderBuilder(double radius, double length, const CylinderElements& n)
      : radius_(radius), length_(length), n_(n), half_(n.square_part * radius) {}

  MeshFile build() {
    number_square();
    number_rings();
    add_square_quads();
    add_ring_quads();
    add_ties();
    return extrude();
  }

 private:
  struct Quad {
    std::array<int, 4> nodes;
    int skin_side;  ///< face index that lies on the mantle, or −1
  };
  struct PlaneTie {
    int node, parameter, to_node, to_parameter;
    double factor;
  };

  int add(const PlaneNode& node) {
    plane_.push_back(node);
    return static_cast<int>(plane_.size()) - 1;
  }

  void number_square() {
    const double step = 2 * half_ / n_.square;
    for (int j = 0; j <= n_.square; ++j)
      for (int i = 0; i <= n_.square; ++i)
        add({Vector2d(-half_ + i * step, -half_ + j * step), Vector2d(step, 0), Vector2d(0, step),
             Vector2d::Zero()});
  }
  int square_node(int i, int j) const { return i + (n_.square + 1) * j; }

  /// Node of the square at place s, anticlockwise, of the side that faces patch q.
  int side_node(int q, int s) const {
    const int n = n_.square;
    return q == 0   ? square_node(n, s)
           : q == 1 ? square_node(n - s, n)
           : q == 2 ? square_node(0, n - s)
                    : square_node(s, 0);
  }

  /// Position, radial, side and mixed derivative in the patch at +x.
  PlaneNode ring_place(int r, int s) const {
    const auto [rho, rate] = graded(r, n_.ring, n_.ring_grading);
    const double t = -1 + 2.0 * s / n_.square;
    const double angle = t * std::numbers::pi / 4, arc = std::numbers::pi / 2 / n_.square;
    // The Hermite cubic with this end slope meets the circle at the middle of the arc.
    const double arc_slope = 4 * std::tan(arc / 4) * radius_;
    const Vector2d flat(half_, half_ * t);
    const Vector2d round = radius_ * Vector2d(std::cos(angle), std::sin(angle));
    const Vector2d round_slope = arc_slope * Vector2d(-std::sin(angle), std::cos(angle));
    Vector2d flat_slope(0, 2 * half_ / n_.square);
    // On the diagonals both patches take the mean of their slopes, so that they meet C¹.
    if (r > 0 && s == n_.square) flat_slope = (flat_slope + turned(flat_slope, 1)) / 2;
    if (r > 0 && s == 0) flat_slope = (flat_slope + turned(flat_slope, 3)) / 2;
    return {(1 - rho) * flat + rho * round, (round - flat) * rate,
            (1 - rho) * flat_slope + rho * round_slope, (round_slope - flat_slope) * rate};
  }

  PlaneNode turned_place(int q, int r, int s) const {
    PlaneNode p = ring_place(r, s);
    for (auto& v : p) v = turned(v, q);
    const Vector2d radial = turns[q].radial * p[1], side = turns[q].side * p[2];
    const Vector2d mixed = turns[q].radial * turns[q].side * p[3];
    return turns[q].radial_is_first ? PlaneNode{p[0], radial, side, mixed}
                                    : PlaneNode{p[0], side, radial, mixed};
  }

  void number_rings() {
    for (int q = 0; q < 4; ++q)
      for (int r = 0; r <= n_.ring; ++r)
        for (int s = 0; s <= n_.square; ++s) {
          const PlaneNode place = turned_place(q, r, s);
          const bool on_side = r == 0 && s > 0 && s < n_.square;
          if (on_side) plane_[side_node(q, s)] = place;
          ring_nodes_.push_back(on_side ? side_node(q, s) : add(place));
        }
  }
  int ring_node(int q, int r, int s) const {
    return ring_nodes_[(q * (n_.ring + 1) + r) * (n_.square + 1) + s];
  }

  void add_square_quads() {
    for (int j = 0; j < n_.square; ++j)
      for (int i = 0; i < n_.square; ++i)
        quads_.push_back({{square_node(i, j), square_node(i + 1, j), square_node(i, j + 1),
                           square_node(i + 1, j + 1)},
                          -1});
  }

  void add_ring_quads() {
    for (int q = 0; q < 4; ++q)
      for (int r = 0; r < n_.ring; ++r)
        for (int s = 0; s < n_.square; ++s) {
          const Turn& turn = turns[q];
          Quad quad{{}, -1};
          for (int c = 0; c < 4; ++c) {
            const int along = turn.radial_is_first ? c & 1 : c >> 1;
            const int across = turn.radial_is_first ? c >> 1 : c & 1;
            quad.nodes[c] = ring_node(q, r + (turn.radial > 0 ? along : 1 - along),
                                      s + (turn.side > 0 ? across : 1 - across));
          }
          if (r == n_.ring - 1)
            quad.skin_side = (turn.radial_is_first ? 0 : 2) + (turn.radial > 0 ? 1 : 0);
          quads_.push_back(quad);
        }
  }

  /// Plane parameter that is differentiated along the patch's radial or side direction.
  static int parameter(int q, bool radial, bool side) {
    return turns[q].radial_is_first ? radial + 2 * side : side + 2 * radial;
  }

  /// Node b of patch q + 1 takes the parameter of node a of patch q, with its sense.
  void tie_across(int q, int a, int b, bool radial, bool side) {
    const int next = (q + 1) % 4;
    const double factor = (radial ? turns[q].radial * turns[next].radial : 1) *
                          (side ? turns[q].side * turns[next].side : 1);
    ties_.push_back({b, parameter(next, radial, side), a, parameter(q, radial, side), factor});
  }

  void add_ties() {
    const int n = n_.square;
    for (int q = 0; q < 4; ++q) {
      const int next = (q + 1) % 4;
      for (int r = 1; r <= n_.ring; ++r)
        for (bool radial : {false, true})
          for (bool side : {false, true})
            tie_across(q, ring_node(q, r, n), ring_node(next, r, 0), radial, side);
      const int corner = side_node(q, n), a = ring_node(q, 0, n), b = ring_node(next, 0, 0);
      for (bool side : {false, true}) {
        ties_.push_back({a, parameter(q, false, side), corner, parameter(q, false, side), 1});
        ties_.push_back({b, parameter(next, false, side), corner, parameter(next, false, side), 1});
      }
      tie_across(q, a, b, true, false);
    }
  }

  MeshFile extrude() const {
    const int layer = static_cast<int>(plane_.size());
    std::vector<HermiteMesh::Node> nodes;
    std::vector<ParameterTie> ties;
    for (int k = 0; k <= n_.length; ++k) {
      const auto [z, rate] = graded(k, n_.length, n_.length_grading);
      for (const auto& p : plane_) {
        HermiteMesh::Node node = HermiteMesh::Node::Zero();
        for (int d = 0; d < 4; ++d) node.col(d).head<2>() = p[d];
        node(2, 0) = z * length_;
        node(2, 4) = rate * length_;
        nodes.push_back(node);
      }
      for (const auto& t : ties_)
        for (int along : {0, 4})
          ties.push_back({t.node + k * layer, t.parameter + along, t.to_node + k * layer,
                          t.to_parameter + along, t.factor});
    }
    std::vector<HermiteMesh::Corners> elements;
    std::vector<FaceLabels> faces;
    for (int k = 0; k < n_.length; ++k)
      for (const auto& quad : quads_) {
        auto& corners = elements.emplace_back();
        for (int c = 0; c < 8; ++c) corners[c] = quad.nodes[c & 3] + (k + (c >> 2)) * layer;
        auto& labels = faces.emplace_back();
        labels.fill(FaceLabel::interior);
        if (quad.skin_side >= 0) labels[quad.skin_side] = FaceLabel::skin;
        if (k == 0) labels[4] = FaceLabel::cut;
        if (k == n_.length - 1) labels[5] = FaceLabel::cut;
      }
    return {HermiteMesh(std::move(nodes), std::move(elements)), faces, ties, {}, {}, {}};
  }

  double radius_, length_;
  CylinderElements n_;
  double half_;  ///< half side of the square [mm]
  std::vector<PlaneNode> plane_;
  std::vector<int> ring_nodes_;
  std::vector<Quad> quads_;
  std::vector<PlaneTie> ties_;
};

}  // namespace

MeshFile cylinder_mesh(double radius, double length, const CylinderElements& elements) {
  if (radius <= 0 || length <= 0)
    throw std::invalid_argument("cylinder_mesh: radius and length must be positive");
  if (std::min({elements.square, elements.ring, elements.length}) < 1)
    throw std::invalid_argument("cylinder_mesh: needs at least 1 element in every direction");
  if (elements.square_part <= 0 || elements.square_part >= 0.7)
    throw std::invalid_argument("cylinder_mesh: square_part must lie in (0, 0.7)");
  if (elements.ring_grading <= 0 || elements.length_grading <= 0)
    throw std::invalid_argument("cylinder_mesh: gradings must be positive");
  return CylinderBuilder(radius, length, elements).build();
}

}  // namespace mammotwin
