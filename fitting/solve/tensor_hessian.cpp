#include "fitting/solve/tensor_hessian.h"

#include <cmath>

#include "fitting/mesh/hermite_basis.h"

namespace mammotwin {

namespace {

constexpr int width = 16;  // pairs of four functions

/// Four numbers anywhere in an array; a machine without such registers uses two.
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));

/// out[m] += Σ_k in[k][m] table[k]: contracts the slowest index of `in` and appends a pair of
/// functions as the fastest. `count` is even: two m at a time share the table in their registers,
/// which wider vectors would spill. One body, two instruction sets; the loader picks one.
__attribute__((target_clones("arch=x86-64-v3", "default"))) void contract(
    const std::vector<double>& in, std::size_t from, int count, const std::vector<double>& table,
    std::vector<double>& out) {
  const int n = static_cast<int>(table.size()) / width;
  for (int m = 0; m < count; m += 2) {
    Four* to = reinterpret_cast<Four*>(&out[static_cast<std::size_t>(width) * m]);
    Four a0 = to[0], a1 = to[1], a2 = to[2], a3 = to[3];
    Four b0 = to[4], b1 = to[5], b2 = to[6], b3 = to[7];
    for (int k = 0; k < n; ++k) {
      const Four* t = reinterpret_cast<const Four*>(&table[static_cast<std::size_t>(width) * k]);
      const double* x = &in[from + static_cast<std::size_t>(k) * count + m];
      a0 += x[0] * t[0], a1 += x[0] * t[1], a2 += x[0] * t[2], a3 += x[0] * t[3];
      b0 += x[1] * t[0], b1 += x[1] * t[1], b2 += x[1] * t[2], b3 += x[1] * t[3];
    }
    to[0] = a0, to[1] = a1, to[2] = a2, to[3] = a3;
    to[4] = b0, to[5] = b1, to[6] = b2, to[7] = b3;
  }
}

/// Of the parameter p = 8·corner + d: its function along each direction.
std::array<int, 3> functions(int p) {
  const int corner = p / 8, d = p % 8;
  return {2 * (corner & 1) + (d & 1), (corner & 2) + (d >> 1 & 1), 2 * (corner >> 2) + (d >> 2)};
}

/// What p adds to the place of (p, r) among pairs of functions of all three directions; r adds a
/// quarter of its own.
std::array<int, 64> places_of_rows() {
  std::array<int, 64> places;
  for (int p = 0; p < 64; ++p) {
    const auto [a, b, c] = functions(p);
    places[p] = 1024 * a + 64 * b + 4 * c;
  }
  return places;
}

/// Adds what stands at [pair][a a'][b b'][c c'], and its mirror image.
void add_by_place(const std::vector<double>& by_place, Eigen::MatrixXd& hessian) {
  static const std::array<int, 64> places = places_of_rows();
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b <= c; ++b) {
      const double* of_pair = &by_place[static_cast<std::size_t>(TensorHessian::pair(c, b)) << 12];
      for (int r = 0; r < 64; ++r)
        for (int p = 0; p < 64; ++p) {
          const double entry = of_pair[places[p] + places[r] / 4];
          hessian(3 * p + c, 3 * r + b) += entry;
          if (b != c) hessian(3 * r + b, 3 * p + c) += entry;
        }
    }
}

}  // namespace

TensorHessian::TensorHessian(const std::vector<double>& points, const Eigen::Vector3d& lengths)
    : n_(static_cast<int>(points.size())), points_(points) {
  for (int direction = 0; direction < 3; ++direction)
    for (int kind = 0; kind < 4; ++kind)
      for (double t : points) {
        const HermiteValues rows = hermite_derivatives(t, kind >> 1);
        const HermiteValues columns = hermite_derivatives(t, kind & 1);
        const double by = std::pow(lengths[direction], -(kind >> 1) - (kind & 1));
        for (double row : rows)
          for (double column : columns) tables_[direction][kind].push_back(row * column * by);
      }
}

Eigen::Vector3d TensorHessian::point(int q) const {
  return {points_[q / (n_ * n_)], points_[q / n_ % n_], points_[q % n_]};
}

void TensorHessian::add(const std::vector<double>& tensors, Eigen::MatrixXd& hessian) const {
  const int after_1 = n_ * n_ * num_pairs, after_2 = n_ * num_pairs * width,
            after_3 = num_pairs * width * width;
  std::vector<double> by_3(static_cast<std::size_t>(after_3) * width, 0.0);
  for (const bool i_is_3 : {false, true})
    for (const bool j_is_3 : {false, true}) {
      std::vector<double> by_2(static_cast<std::size_t>(after_2) * width, 0.0);
      for (int i = i_is_3 ? 2 : 0; i <= (i_is_3 ? 2 : 1); ++i)
        for (int j = j_is_3 ? 2 : 0; j <= (j_is_3 ? 2 : 1); ++j) {
          std::vector<double> by_1(static_cast<std::size_t>(after_1) * width, 0.0);
          contract(tensors, place(i, j, 0), after_1, table(0, i, j), by_1);
          contract(by_1, 0, after_2, table(1, i, j), by_2);
        }
      contract(by_2, 0, after_3, table(2, i_is_3 ? 2 : 0, j_is_3 ? 2 : 0), by_3);
    }
  add_by_place(by_3, hessian);
}

}  // namespace mammotwin
