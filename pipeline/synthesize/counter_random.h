#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace mammotwin {

/// SplitMix64's finaliser (Steele, Lea, Flood: Fast splittable pseudorandom number generators,
/// OOPSLA 2014): a bijection of 64-bit words that passes for random.
inline std::uint64_t scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Random numbers as a function of (seed, stream, counter): number n of a stream does not depend
/// on how many were drawn elsewhere, so threads and code order cannot change a patient. Only
/// integer and IEEE arithmetic: the same on every machine.
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter = 0)
      : key_(scramble(scramble(seed) ^ stream)), counter_(counter) {}

  std::uint64_t bits() { return scramble(key_ ^ scramble(counter_++)); }

  /// Uniform in [0, 1), in steps of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Nearly standard normal: sum of 12 uniforms less 6, whose tails end at 6 and whose excess
  /// kurtosis is -0.1. Needs no logarithm, whose last bit depends on the machine.
  double normal() {
    constexpr std::uint64_t mask = (1u << 21) - 1;  // three 21-bit uniforms a word
    std::uint64_t sum = 0;
    for (int i = 0; i < 4; ++i) {
      const std::uint64_t word = bits();
      sum += (word & mask) + ((word >> 21) & mask) + ((word >> 42) & mask);
    }
    return static_cast<double>(sum) * 0x1p-21 - 6 + 6 * 0x1p-21;
  }

  /// Uniform on the unit sphere (by rejection from the cube).
  Eigen::Vector3d direction() {
    while (true) {
      const Eigen::Vector3d v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      const double squared = v.squaredNorm();
      if (squared > 1e-4 && squared <= 1) return v / std::sqrt(squared);
    }
  }

 private:
  std::uint64_t key_, counter_;
};

}  // namespace mammotwin
