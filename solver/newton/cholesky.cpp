#include "solver/newton/cholesky.h"

#include "solver/newton/blas_kernels.h"

#include <suitesparse/cholmod.h>

#include <stdexcept>

namespace mammotwin {

struct Cholesky::Implementation {
  cholmod_common common;
  cholmod_sparse matrix{};
  cholmod_factor* factor = nullptr;

  Implementation() {
    use_one_blas_thread();
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = true;
    common.print = 0;
    common.quick_return_if_not_posdef = true;
  }
  ~Implementation() {
    if (factor) cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

namespace {

cholmod_sparse as_cholmod(const SparsePattern& pattern) {
  cholmod_sparse A{};
  A.nrow = A.ncol = pattern.num_columns();
  A.nzmax = pattern.rows.size();
  A.p = const_cast<int*>(pattern.starts.data());
  A.i = const_cast<int*>(pattern.rows.data());
  A.stype = -1;  // lower triangle
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

}  // namespace

Cholesky::Cholesky(const SparsePattern& pattern)
    : implementation_(std::make_unique<Implementation>()) {
  auto& self = *implementation_;
  self.matrix = as_cholmod(pattern);
  self.matrix.xtype = CHOLMOD_PATTERN;
  self.factor = cholmod_analyze(&self.matrix, &self.common);
  self.matrix.xtype = CHOLMOD_REAL;
  if (!self.factor) throw std::runtime_error("CHOLMOD could not analyse the tangent's pattern");
}

Cholesky::~Cholesky() = default;

bool Cholesky::factor(const std::vector<double>& values) {
  auto& self = *implementation_;
  self.matrix.x = const_cast<double*>(values.data());
  cholmod_factorize(&self.matrix, self.factor, &self.common);
  if (self.common.status < CHOLMOD_OK)
    throw std::runtime_error("CHOLMOD ran out of memory while factoring the tangent");
  return self.common.status == CHOLMOD_OK && self.factor->minor == self.factor->n;
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const {
  auto& self = *implementation_;
  cholmod_dense rhs{};
  rhs.nrow = rhs.d = rhs.nzmax = b.size();
  rhs.ncol = 1;
  rhs.x = const_cast<double*>(b.data());
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, self.factor, &rhs, &self.common);
  if (!x) throw std::runtime_error("CHOLMOD could not solve with the tangent's factor");
  Eigen::VectorXd solution =
      Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x->x), b.size());
  cholmod_free_dense(&x, &self.common);
  return solution;
}

double Cholesky::flops() const { return implementation_->common.fl; }

}  // namespace mammotwin
