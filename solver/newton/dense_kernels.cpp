#include "solver/newton/dense_kernels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

extern "C" {
void dpotrf_(const char*, const int*, double*, const int*, int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*,
            const double*, const double*, const int*, double*, const int*);
void dtrsv_(const char*, const char*, const char*, const int*, const double*, const int*, double*,
            const int*);
void dgemv_(const char*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
            const double*, const int*, const double*, const int*, const double*, double*,
            const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*,
            const int*, const double*, double*, const int*);
}

namespace mammotwin {

namespace {

constexpr int kTile = 256;  // large enough for BLAS's rate, small enough to share out

int tiles(int size) { return (size + kTile - 1) / kTile; }

template <class Work>
void for_tiles(int count, Work work) {
  if (count == 1) return work(0);
  tbb::parallel_for(0, count, work);
}

/// A₂ := A₂ L⁻ᵀ, rows in tiles.
void divide_rows(const double* L, int stride, int pivots, double* A2, int rows) {
  const double one = 1;
  for_tiles(tiles(rows), [&](int t) {
    const int count = std::min(kTile, rows - t * kTile);
    dtrsm_("R", "L", "T", "N", &count, &pivots, &one, L, &stride, A2 + t * kTile, &stride);
  });
}

/// C = kept C − A Aᵀ for C of columns [0, columns) and all rows below the diagonal, in tiles; A has
/// `rows`.
void subtract_tiles(const double* A, int stride, int rows, int columns, int depth, double* C,
                    int c_stride, double kept) {
  const double minus_one = -1;
  std::vector<std::pair<int, int>> work;
  for (int j = 0; j < tiles(columns); ++j)
    for (int i = j; i < tiles(rows); ++i) work.push_back({i, j});
  for_tiles(static_cast<int>(work.size()), [&](int w) {
    const auto [i, j] = work[w];
    const int height = std::min(kTile, rows - i * kTile);
    const int width = std::min(kTile, columns - j * kTile);
    const double *Ai = A + i * kTile, *Aj = A + j * kTile;
    double* Cij = C + i * kTile + static_cast<std::ptrdiff_t>(j) * kTile * c_stride;
    if (i != j) {
      dgemm_("N", "T", &height, &width, &depth, &minus_one, Ai, &stride, Aj, &stride, &kept, Cij,
             &c_stride);
      return;
    }
    dsyrk_("L", "N", &width, &depth, &minus_one, Aj, &stride, &kept, Cij, &c_stride);
    const int below = height - width;
    if (below > 0)
      dgemm_("N", "T", &below, &width, &depth, &minus_one, Ai + width, &stride, Aj, &stride, &kept,
             Cij + width, &c_stride);
  });
}

}  // namespace

bool factor_panel(const Panel& panel) {
  const auto [values, rows, pivots] = panel;
  for (int first = 0; first < pivots; first += kTile) {
    const int width = std::min(kTile, pivots - first);
    double* block = values + first + static_cast<std::ptrdiff_t>(first) * rows;
    int info = 0;
    dpotrf_("L", &width, block, &rows, &info);
    if (info != 0) return false;
    const int below = rows - first - width;
    if (below == 0) continue;
    divide_rows(block, rows, width, block + width, below);
    const int columns = pivots - first - width;
    if (columns > 0)
      subtract_tiles(block + width, rows, below, columns, width,
                     block + width + static_cast<std::ptrdiff_t>(width) * rows, rows, 1);
  }
  return true;
}

void subtract_outer_product(const Panel& factored, double kept, double* update) {
  const auto [values, rows, pivots] = factored;
  subtract_tiles(values + pivots, rows, rows - pivots, rows - pivots, pivots, update, rows - pivots,
                 kept);
}

void solve_lower(const ConstPanel& factored, double* x) {
  const auto [values, rows, pivots] = factored;
  const int one = 1, rest = rows - pivots;
  const double minus = -1, plus = 1;
  dtrsv_("L", "N", "N", &pivots, values, &rows, x, &one);
  if (rest > 0)
    dgemv_("N", &rest, &pivots, &minus, values + pivots, &rows, x, &one, &plus, x + pivots, &one);
}

void solve_lower_transposed(const ConstPanel& factored, double* x) {
  const auto [values, rows, pivots] = factored;
  const int one = 1, rest = rows - pivots;
  const double minus = -1, plus = 1;
  if (rest > 0)
    dgemv_("T", &rest, &pivots, &minus, values + pivots, &rows, x + pivots, &one, &plus, x, &one);
  dtrsv_("L", "T", "N", &pivots, values, &rows, x, &one);
}

}  // namespace mammotwin
