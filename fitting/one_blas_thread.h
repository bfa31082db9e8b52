#pragma once

namespace mammotwin {

/// While it lives, BLAS and OpenMP run on one thread. Debian's OpenBLAS gives other last bits with
/// two, and CHOLMOD assembles supernodes with four OpenMP threads whatever is asked: on a busy
/// machine they spend more time waiting for each other than working.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int blas_threads_, openmp_levels_;
};

}  // namespace mammotwin
