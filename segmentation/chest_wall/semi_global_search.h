#pragma once

#include <vector>

namespace mammotwin {

/// A height map over a grid of `rows` x `columns` that is cheap and smooth.
///
/// `cost[(row * columns + column) * depths + d]` is the price of depth d there; neighbours pay
/// `stiffness` times their squared difference, at most `max_jump` apart. Costs are summed along
/// paths from 8 directions and the smallest sum wins, after Hirschmueller, IEEE PAMI 30 (2008),
/// 328-341. Returns the depth of each grid point, between the integers where the sums' parabola
/// says so.
std::vector<double> semi_global_search(const std::vector<float>& cost, int rows, int columns,
                                       int depths, double stiffness, int max_jump);

}  // namespace mammotwin
