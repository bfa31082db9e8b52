#include "solver/element/tensor_kernels.h"

// One body, three instruction sets; the loader picks one.
#define MAMMOTWIN_MULTIVERSION \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define MAMMOTWIN_INLINE __attribute__((always_inline)) inline

namespace mammotwin {

namespace {

/// Eight numbers side by side; a machine without such registers uses several.
using Octet = double __attribute__((vector_size(64)));

/// The same anywhere in an array.
using Unaligned = double __attribute__((vector_size(64), aligned(8), may_alias));

MAMMOTWIN_INLINE const Unaligned& at(const double* p) {
  return *reinterpret_cast<const Unaligned*>(p);
}
MAMMOTWIN_INLINE Unaligned& at(double* p) { return *reinterpret_cast<Unaligned*>(p); }

using Matrix1d = double[kPoints1d][4];

const Matrix1d& functions(const HermiteTable& table, bool differentiated) {
  return differentiated ? table.slope : table.value;
}

/// out[s][q][r] = Σ_t in[s][t][r] matrix[q][t]: contracts the middle of three indices.
template <int slow, int fast>
MAMMOTWIN_INLINE void to_points(const Matrix1d& matrix, const double* in, double* out) {
  for (int s = 0; s < slow; ++s)
    for (int q = 0; q < 4; ++q)
      for (int r = 0; r < fast; ++r) {
        double sum = 0;
        for (int t = 0; t < 4; ++t) sum += matrix[q][t] * in[(4 * s + t) * fast + r];
        out[(4 * s + q) * fast + r] = sum;
      }
}

/// out[s][t][r] += Σ_q in[s][q][r] matrix[q][t].
template <int slow, int fast>
MAMMOTWIN_INLINE void add_from_points(const Matrix1d& matrix, const double* in, double* out) {
  for (int s = 0; s < slow; ++s)
    for (int t = 0; t < 4; ++t)
      for (int r = 0; r < fast; ++r) {
        double sum = 0;
        for (int q = 0; q < 4; ++q) sum += matrix[q][t] * in[(4 * s + q) * fast + r];
        out[(4 * s + t) * fast + r] += sum;
      }
}

/// Products of one-dimensional functions: pairs[m][q][t + 4 t'], where bit 1 of m says that the
/// row's function t is differentiated, bit 0 that the column's t' is.
struct PairTable {
  double pairs[4][kPoints1d][16];
  double by_pair[16][16];  ///< the same as [t + 4 t'][4 m + q]
  PairTable() {
    const HermiteTable& table = hermite_table();
    for (int m = 0; m < 4; ++m)
      for (int q = 0; q < kPoints1d; ++q)
        for (int t = 0; t < 16; ++t)
          by_pair[t][4 * m + q] = pairs[m][q][t] =
              functions(table, m >> 1)[q][t & 3] * functions(table, m & 1)[q][t >> 2];
  }
};

const PairTable& pair_table() {
  static const PairTable table;
  return table;
}

constexpr int derivative_pair(int J, int L, int direction) {
  return 2 * (J == direction) + (L == direction);
}

/// ξ₁ then ξ₂: plane[q₃][t₂ pair] += Σ_q₂ pairs2[q₂][t₂ pair] Σ_q₁ c[q₃][q₂][q₁] pairs1[q₁].
MAMMOTWIN_INLINE void add_plane(const double* c, const double (*pairs1)[16],
                                const double (*pairs2)[16], Octet (*plane)[16][2]) {
  for (int q3 = 0; q3 < 4; ++q3) {
    Octet line[4][2];
    for (int q2 = 0; q2 < 4; ++q2)
      for (int h = 0; h < 2; ++h) {
        line[q2][h] = c[16 * q3 + 4 * q2] * at(pairs1[0] + 8 * h);
        for (int q1 = 1; q1 < 4; ++q1)
          line[q2][h] += c[16 * q3 + 4 * q2 + q1] * at(pairs1[q1] + 8 * h);
      }
    for (int p2 = 0; p2 < 16; ++p2)
      for (int h = 0; h < 2; ++h) {
        Octet sum = pairs2[0][p2] * line[0][h];
        for (int q2 = 1; q2 < 4; ++q2) sum += pairs2[q2][p2] * line[q2][h];
        plane[q3][p2][h] += sum;
      }
  }
}

}  // namespace

MAMMOTWIN_MULTIVERSION
void gradient_at_points(const double* coefficients, double* gradient) {
  const HermiteTable& table = hermite_table();
  double value3[64], slope3[64], value32[64], value3_slope2[64], slope3_value2[64];
  to_points<1, 16>(table.value, coefficients, value3);
  to_points<1, 16>(table.slope, coefficients, slope3);
  to_points<4, 4>(table.value, value3, value32);
  to_points<4, 4>(table.slope, value3, value3_slope2);
  to_points<4, 4>(table.value, slope3, slope3_value2);
  to_points<16, 1>(table.slope, value32, gradient);
  to_points<16, 1>(table.value, value3_slope2, gradient + 64);
  to_points<16, 1>(table.value, slope3_value2, gradient + 128);
}

MAMMOTWIN_MULTIVERSION
void add_gradient_transposed(const double* flux, double* residual) {
  const HermiteTable& table = hermite_table();
  double value32[64] = {}, value3_slope2[64] = {}, slope3_value2[64] = {};
  double value3[64] = {}, slope3[64] = {};
  add_from_points<16, 1>(table.slope, flux, value32);
  add_from_points<16, 1>(table.value, flux + 64, value3_slope2);
  add_from_points<16, 1>(table.value, flux + 128, slope3_value2);
  add_from_points<4, 4>(table.value, value32, value3);
  add_from_points<4, 4>(table.slope, value3_slope2, value3);
  add_from_points<4, 4>(table.value, slope3_value2, slope3);
  add_from_points<1, 16>(table.value, value3, residual);
  add_from_points<1, 16>(table.slope, slope3, residual);
}

MAMMOTWIN_MULTIVERSION
void tangent_block(const double* coefficients, double* block) {
  const PairTable& table = pair_table();
  Octet plane[4][4][16][2] = {};  // [pair of ξ₃ derivatives][q₃][t₂ pair][half of t₁ pairs]
  for (int J = 0; J < 3; ++J)
    for (int L = 0; L < 3; ++L)
      add_plane(coefficients + 64 * (3 * J + L), table.pairs[derivative_pair(J, L, 0)],
                table.pairs[derivative_pair(J, L, 1)], plane[derivative_pair(J, L, 2)]);
  for (int p2 = 0; p2 < 16; ++p2)
    for (int h = 0; h < 2; ++h) {
      Octet in[16];
      for (int k = 0; k < 16; ++k) in[k] = plane[k >> 2][k & 3][p2][h];
      for (int p3 = 0; p3 < 16; ++p3) {
        Octet sum = table.by_pair[p3][0] * in[0];
        for (int k = 1; k < 16; ++k) sum += table.by_pair[p3][k] * in[k];
        const int a = 16 * (p3 & 3) + 4 * (p2 & 3), b = 16 * (p3 >> 2) + 4 * (p2 >> 2) + 2 * h;
        for (int t = 0; t < 8; ++t) block[a + (t & 3) + 64 * (b + (t >> 2))] = sum[t];
      }
    }
}

MAMMOTWIN_MULTIVERSION
void add_outer_product(const double* factor, int columns, double* matrix) {
  for (int c = 0; c < kUnknowns; c += 4)
    for (int r = c & ~7; r < kUnknowns; r += 8) {  // from the diagonal's octet down
      Octet sum[4];
      for (int k = 0; k < 4; ++k) sum[k] = at(matrix + kUnknowns * (c + k) + r);
      for (int m = 0; m < columns; ++m) {
        const double* f = factor + kUnknowns * m;
        for (int k = 0; k < 4; ++k) sum[k] += f[c + k] * at(f + r);
      }
      for (int k = 0; k < 4; ++k) at(matrix + kUnknowns * (c + k) + r) = sum[k];
    }
}

}  // namespace mammotwin
