#pragma once

#include <cstddef>
#include <vector>

namespace mammotwin {

/// Numbers that are neighbours both where they come from and where they go.
struct Stretch {
  int from, to, count;
};

/// One more number: it lengthens the last stretch where it follows that (of those from `first` on),
/// else it begins one.
inline void append(int from, int to, std::size_t first, std::vector<Stretch>& stretches) {
  if (stretches.size() > first) {
    Stretch& last = stretches.back();
    if (from == last.from + last.count && to == last.to + last.count) {
      ++last.count;
      return;
    }
  }
  stretches.push_back({from, to, 1});
}

inline void add(const Stretch& stretch, const double* source, double* target) {
  for (int i = 0; i < stretch.count; ++i) target[stretch.to + i] += source[stretch.from + i];
}

}  // namespace mammotwin
