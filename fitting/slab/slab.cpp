#include "fitting/slab/slab.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "fitting/mesh/block_mesh.h"
#include "fitting/mesh/hermite_basis.h"

namespace mammotwin {

namespace {

/// Weight of the squared second derivatives over [0,1]², against a mean squared distance: it
/// only decides where there is no data.
constexpr double start_smoothing = 1e-7;

/// Bicubic Hermite surface over nx x ny patches; parameter 4·node + (0: x, 1: ∂₁, 2: ∂₂, 3: ∂₁₂).
class SurfaceFit {
 public:
  SurfaceFit(int nx, int ny)
      : nx_(nx),
        ny_(ny),
        size_(4 * (nx + 1) * (ny + 1)),
        normal_(Eigen::MatrixXd::Zero(size_, size_)),
        right_(Eigen::MatrixXd::Zero(size_, 3)) {
    add_smoothing();
  }

  void add(const Eigen::Vector2d& uv, const Eigen::Vector3d& x, double weight) {
    const Row row = basis(uv, 0, 0);
    for (int a = 0; a < 16; ++a) {
      right_.row(row.index[a]) += weight * row.value[a] * x.transpose();
      for (int b = 0; b < 16; ++b)
        normal_(row.index[a], row.index[b]) += weight * row.value[a] * row.value[b];
    }
  }

  /// Solves with x held on the sides u = 0 and 1 (component 0) and v = 0 and 1 (component 2).
  Eigen::MatrixXd solve(const BreastRegion& region) const {
    Eigen::MatrixXd result(size_, 3);
    for (int component = 0; component < 3; ++component) {
      std::vector<int> free;
      Eigen::VectorXd x = Eigen::VectorXd::Zero(size_);
      for (int p = 0; p < size_; ++p)
        if (!held(p, component, region, x[p])) free.push_back(p);
      const Eigen::VectorXd residual = right_.col(component) - normal_ * x;
      const Eigen::MatrixXd normal = normal_(free, free);
      const Eigen::VectorXd right = residual(free);
      const Eigen::VectorXd solution = normal.ldlt().solve(right);
      x(free) = solution;
      result.col(component) = x;
    }
    return result;
  }

 private:
  struct Row {
    std::array<int, 16> index;
    std::array<double, 16> value;
  };

  Row basis(const Eigen::Vector2d& uv, int order_u, int order_v) const {
    const int i = std::clamp(static_cast<int>(uv.x() * nx_), 0, nx_ - 1);
    const int j = std::clamp(static_cast<int>(uv.y() * ny_), 0, ny_ - 1);
    const HermiteValues h = hermite_derivatives(uv.x() * nx_ - i, order_u);
    const HermiteValues g = hermite_derivatives(uv.y() * ny_ - j, order_v);
    Row row;
    for (int a = 0; a < 16; ++a) {
      const int end_u = a & 1, end_v = a >> 1 & 1, du = a >> 2 & 1, dv = a >> 3;
      row.index[a] = 4 * (i + end_u + (nx_ + 1) * (j + end_v)) + du + 2 * dv;
      row.value[a] = h[2 * end_u + du] * g[2 * end_v + dv];
    }
    return row;
  }

  void add_smoothing() {
    for (int p = 0; p < 16 * nx_ * ny_; ++p) {
      const int patch = p / 16;
      const Eigen::Vector2d uv((patch % nx_ + (p % 4 + 0.5) / 4) / nx_,
                               (patch / nx_ + (p / 4 % 4 + 0.5) / 4) / ny_);
      for (const auto& [du, dv, times] : {std::array{2, 0, 1}, {1, 1, 2}, {0, 2, 1}}) {
        const Row row = basis(uv, du, dv);
        const double scale = std::pow(nx_, du) * std::pow(ny_, dv);
        const double w = start_smoothing * times * scale * scale / (16 * nx_ * ny_);
        for (int a = 0; a < 16; ++a)
          for (int b = 0; b < 16; ++b)
            normal_(row.index[a], row.index[b]) += w * row.value[a] * row.value[b];
      }
    }
  }

  bool held(int p, int component, const BreastRegion& region, double& value) const {
    const int node = p / 4, i = node % (nx_ + 1), j = node / (nx_ + 1), d = p % 4;
    const bool side_u = component == 0 && (i == 0 || i == nx_) && !(d & 1);
    const bool side_v = component == 2 && (j == 0 || j == ny_) && !(d & 2);
    if (d == 0 && side_u) value = i == 0 ? region.x_min : region.x_max;
    if (d == 0 && side_v) value = j == 0 ? region.z_min : region.z_max;
    return side_u || side_v;
  }

  int nx_, ny_, size_;
  Eigen::MatrixXd normal_, right_;
};

Eigen::MatrixXd fit_skin(const Slab& slab, const TriangleSurface& skin, const FlatSkin& flat,
                         const BreastRegion& region) {
  SurfaceFit fit(slab.elements.x(), slab.elements.y());
  for (const auto& t : skin.triangles) {
    const Eigen::Vector2d e1 = flat.uv[t[1]] - flat.uv[t[0]], e2 = flat.uv[t[2]] - flat.uv[t[0]];
    const double area = std::abs(e1.x() * e2.y() - e1.y() * e2.x()) / 2;
    for (int v : t) fit.add(slab.graded(flat.uv[v]), skin.vertices[v], area / 3);
  }
  return fit.solve(region);
}

Eigen::MatrixXd fit_wall(const Slab& slab, const HeightField& wall, const BreastRegion& region) {
  constexpr int samples = 60;  // a side: 2 to 4 mm apart
  SurfaceFit fit(slab.elements.x(), slab.elements.y());
  for (int b = 0; b < samples; ++b)
    for (int a = 0; a < samples; ++a) {
      const Eigen::Vector2d uv((a + 0.5) / samples, (b + 0.5) / samples);
      const double x = region.x_min + slab.grading[0].place(uv.x()) * (region.x_max - region.x_min);
      const double z = region.z_min + slab.grading[1].place(uv.y()) * (region.z_max - region.z_min);
      fit.add(uv, {x, wall(x, z), z}, 1.0 / (samples * samples));
    }
  return fit.solve(region);
}

}  // namespace

HeldParameters held_parameters(const Slab& slab) {
  HeldParameters held(slab.num_nodes());
  for (int k = 0; k <= slab.elements.z(); ++k)
    for (int j = 0; j <= slab.elements.y(); ++j)
      for (int i = 0; i <= slab.elements.x(); ++i)
        for (int d = 0; d < 8; ++d) {
          auto& node = held[slab.node(i, j, k)];
          node[3 * d] = (i == 0 || i == slab.elements.x()) && !(d & 1);
          node[3 * d + 1] = false;
          node[3 * d + 2] = (j == 0 || j == slab.elements.y()) && !(d & 2);
        }
  return held;
}

HermiteMesh straight_start(const Slab& slab, const TriangleSurface& skin, const FlatSkin& flat,
                           const HeightField& wall, const BreastRegion& region) {
  const Eigen::MatrixXd top = fit_skin(slab, skin, flat, region);
  const Eigen::MatrixXd bottom = fit_wall(slab, wall, region);
  const int layer = (slab.elements.x() + 1) * (slab.elements.y() + 1);
  std::vector<HermiteMesh::Node> nodes;
  for (int k = 0; k <= slab.elements.z(); ++k)
    for (int n = 0; n < layer; ++n) {
      const double w = static_cast<double>(k) / slab.elements.z();
      HermiteMesh::Node node;
      for (int d = 0; d < 4; ++d) {
        const Eigen::Vector3d low = bottom.row(4 * n + d), high = top.row(4 * n + d);
        node.col(d) = (1 - w) * low + w * high;
        node.col(d + 4) = (high - low) / slab.elements.z();
      }
      nodes.push_back(node);
    }
  return HermiteMesh(std::move(nodes), grid_corners(slab.elements));
}

std::vector<FaceLabels> slab_faces(const Slab& slab) {
  std::vector<FaceLabels> faces;
  const Eigen::Vector3i n = slab.elements;
  const auto label = [](bool outer, FaceLabel l) { return outer ? l : FaceLabel::interior; };
  for (int k = 0; k < n.z(); ++k)
    for (int j = 0; j < n.y(); ++j)
      for (int i = 0; i < n.x(); ++i)
        faces.push_back({label(i == 0, FaceLabel::cut), label(i == n.x() - 1, FaceLabel::cut),
                         label(j == 0, FaceLabel::cut), label(j == n.y() - 1, FaceLabel::cut),
                         label(k == 0, FaceLabel::chest_wall),
                         label(k == n.z() - 1, FaceLabel::skin)});
  return faces;
}

}  // namespace mammotwin
