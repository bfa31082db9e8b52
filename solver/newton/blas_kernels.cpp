#include "solver/newton/blas_kernels.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

extern "C" {
char* openblas_get_corename();
void openblas_set_num_threads(int);
void* blas_memory_alloc(int);
void blas_memory_free(void*);
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

void reserve_blas_memory() {
  constexpr std::size_t most_a_thread = (std::size_t{128} << 20) + 4096;
  const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
  void* room = mmap(nullptr, threads * most_a_thread, PROT_READ | PROT_WRITE,
                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  munmap(room, threads * most_a_thread);
  std::vector<void*> buffers(threads);
  for (void*& buffer : buffers) buffer = blas_memory_alloc(0);
  for (void* buffer : buffers) blas_memory_free(buffer);
}

}  // namespace mammotwin
