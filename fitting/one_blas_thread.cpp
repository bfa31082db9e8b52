#include "fitting/one_blas_thread.h"

#include <omp.h>

extern "C" {
int openblas_get_num_threads();
void openblas_set_num_threads(int);
}

namespace mammotwin {

OneBlasThread::OneBlasThread()
    : blas_threads_(openblas_get_num_threads()), openmp_levels_(omp_get_max_active_levels()) {
  openblas_set_num_threads(1);
  omp_set_max_active_levels(0);
}

OneBlasThread::~OneBlasThread() {
  openblas_set_num_threads(blas_threads_);
  omp_set_max_active_levels(openmp_levels_);
}

}  // namespace mammotwin
