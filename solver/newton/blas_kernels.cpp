#include "solver/newton/blas_kernels.h"

#include <cstdlib>

extern "C" {
char* openblas_get_corename();
void openblas_set_num_threads(int);
}

namespace mammotwin {

std::string blas_core_type() {
  if (std::getenv("OPENBLAS_CORETYPE")) return "";
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return "";
}

std::string blas_core_in_use() { return openblas_get_corename(); }

void use_one_blas_thread() { openblas_set_num_threads(1); }

}  // namespace mammotwin
