#include "pipeline/evaluate/niftysim/half_ball_mesh.h"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "fitting/mesh/block_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kCoreSize = 0.5;    // half side of the core / radius
constexpr double kCoreRound = 0.5;   // 0: a cube, 1: a ball
constexpr double kSamePlace = 1e-6;  // [mm]

/// The cube [-1, 1]^3 on the ball.
Vector3d ball_of_cube(const Vector3d& q) {
  const Vector3d s = q.cwiseProduct(q);
  const auto factor = [](double a, double b) { return std::sqrt(1 - a / 2 - b / 2 + a * b / 3); };
  return {q.x() * factor(s.y(), s.z()), q.y() * factor(s.z(), s.x()), q.z() * factor(s.x(), s.y())};
}

Vector3d core_point(const Vector3d& q) {
  return kCoreSize * ((1 - kCoreRound) * q + kCoreRound * ball_of_cube(q));
}

/// The sphere over a point of the cube's surface, by equal angles.
Vector3d sphere_point(const Vector3d& q) {
  return (std::numbers::pi / 4 * q.array()).tan().matrix().normalized();
}

/// One block: a grid in coordinates of the cube; in a shell block `axis` runs out of the core.
struct Block {
  int axis = -1;     ///< of the shell; -1: the core
  double sense = 1;  ///< +1: ξ_axis runs outward
  Vector3i elements;
  int first_node = 0;

  Vector3i nodes() const { return elements + Vector3i::Ones(); }
  int node(const Vector3i& g) const {
    return first_node + g.x() + nodes().x() * (g.y() + nodes().y() * g.z());
  }
  /// Point of the half ball at grid coordinates.
  Vector3d point(const Vector3d& g) const {
    Vector3d q = g.cwiseQuotient(elements.cast<double>());  // 0 to 1
    q.x() = 2 * q.x() - 1, q.y() = 2 * q.y() - 1;
    if (axis < 0) return core_point(q);
    const double t = g[axis] / elements[axis], out = sense > 0 ? t : 1 - t;
    q[axis] = sense;
    return (1 - out) * core_point(q) + out * sphere_point(q);
  }
};

std::vector<Block> blocks_of(const HalfBallElements& n) {
  if (n.core < 2 || n.core % 2 != 0 || n.shell < 1)
    throw std::invalid_argument(
        "half_ball_mesh: the core needs an even number of elements, the "
        "shell at least one");
  const Vector3i core(n.core, n.core, n.core / 2);
  std::vector<Block> blocks{{-1, 1, core}};
  for (const auto& [axis, sense] : {std::pair{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}}) {
    Block b{axis, static_cast<double>(sense), core};
    b.elements[axis] = n.shell;
    blocks.push_back(b);
  }
  int nodes = 0;
  for (Block& b : blocks) b.first_node = nodes, nodes += b.nodes().prod();
  return blocks;
}

template <class Visit>
void for_grid(const Vector3i& size, const Visit& visit) {
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) visit(Vector3i(i, j, k));
}

/// Parameters by central differences along the grid; exact to 1e-5 of a length.
template <class Map>
HermiteMesh::Node node_at(const Map& map, const Vector3d& g) {
  constexpr double h = 0.01;
  HermiteMesh::Node node = HermiteMesh::Node::Zero();
  for (int d = 0; d < 8; ++d)
    for (int c = 0; c < 8; ++c) {
      if (c & ~d) continue;
      Vector3d at = g;
      double sign = 1;
      for (int a = 0; a < 3; ++a)
        if (d >> a & 1) at[a] += c >> a & 1 ? h : -h, sign *= c >> a & 1 ? 1 : -1;
      node.col(d) += sign * map(at) / std::pow(2 * h, std::popcount(unsigned(d)));
    }
  return node;
}

/// Nodes of different blocks that stand at one place.
class Places {
 public:
  explicit Places(const std::vector<HermiteMesh::Node>& nodes) : nodes_(nodes) {}
  bool same(int a, int b) const {
    return (nodes_[a].col(0) - nodes_[b].col(0)).norm() < kSamePlace;
  }

 private:
  const std::vector<HermiteMesh::Node>& nodes_;
};

/// Direction `along` of the follower runs as direction `to` of the leader, with a sign.
struct Shared {
  int along, to;
  double sign;
};

/// Grid lines that two nodes at one place have in common: their next nodes stand at one place too.
std::vector<Shared> shared_lines(const Places& places, const Block& a, const Vector3i& ga,
                                 const Block& b, const Vector3i& gb) {
  const auto next = [](const Block& block, Vector3i g, int axis, int step) {
    g[axis] += step;
    return g[axis] < 0 || g[axis] > block.elements[axis] ? -1 : block.node(g);
  };
  std::vector<Shared> shared;
  for (int along = 0; along < 3; ++along)
    for (int to = 0; to < 3; ++to)
      for (const int step : {1, -1})
        for (const int other : {1, -1}) {
          const int m = next(a, ga, along, step), n = next(b, gb, to, other);
          const bool known = !shared.empty() && shared.back().along == along;
          if (m >= 0 && n >= 0 && !known && places.same(m, n))
            shared.push_back({along, to, double(step * other)});
        }
  return shared;
}

std::vector<ParameterTie> ties_of(int follower, int leader, const std::vector<Shared>& lines) {
  std::vector<ParameterTie> ties{{follower, 0, leader, 0, 1}};
  for (const Shared& l : lines) ties.push_back({follower, 1 << l.along, leader, 1 << l.to, l.sign});
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j)
      ties.push_back({follower, 1 << lines[i].along | 1 << lines[j].along, leader,
                      1 << lines[i].to | 1 << lines[j].to, lines[i].sign * lines[j].sign});
  return ties;
}

std::vector<ParameterTie> tie_blocks(const std::vector<Block>& blocks,
                                     const std::vector<HermiteMesh::Node>& nodes) {
  const Places places(nodes);
  std::vector<ParameterTie> ties;
  for (std::size_t a = 1; a < blocks.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for_grid(blocks[a].nodes(), [&](const Vector3i& ga) {
        for_grid(blocks[b].nodes(), [&](const Vector3i& gb) {
          const int follower = blocks[a].node(ga), leader = blocks[b].node(gb);
          if (!places.same(follower, leader)) return;
          const auto lines = shared_lines(places, blocks[a], ga, blocks[b], gb);
          for (const ParameterTie& tie : ties_of(follower, leader, lines)) ties.push_back(tie);
        });
      });
  return ties;
}

FaceLabels labels_of(const Block& b, const Vector3i& g) {
  FaceLabels labels;
  labels.fill(FaceLabel::interior);
  if (g.z() == 0 && b.axis != 2) labels[4] = FaceLabel::chest_wall;
  if (b.axis >= 0 && g[b.axis] == (b.sense > 0 ? b.elements[b.axis] - 1 : 0))
    labels[2 * b.axis + (b.sense > 0)] = FaceLabel::skin;
  return labels;
}

}  // namespace

MeshFile half_ball_mesh(const std::function<Vector3d(const Vector3d&)>& map,
                        const HalfBallElements& n) {
  const std::vector<Block> blocks = blocks_of(n);
  std::vector<HermiteMesh::Node> nodes;
  std::vector<HermiteMesh::Corners> elements;
  MeshFile file{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
  for (const Block& b : blocks) {
    for_grid(b.nodes(), [&](const Vector3i& g) {
      nodes.push_back(
          node_at([&](const Vector3d& at) { return map(b.point(at)); }, g.cast<double>()));
    });
    for (auto corners : grid_corners(b.elements)) {
      for (int& corner : corners) corner += b.first_node;
      elements.push_back(corners);
    }
    for_grid(b.elements, [&](const Vector3i& g) { file.faces.push_back(labels_of(b, g)); });
  }
  file.ties = tie_blocks(blocks, nodes);
  for (const ParameterTie& t : file.ties)
    nodes[t.node].col(t.parameter) = t.factor * nodes[t.to_node].col(t.to_parameter);
  file.mesh = HermiteMesh(std::move(nodes), std::move(elements));
  return file;
}

}  // namespace mammotwin
