#include "segmentation/body/apices.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mammotwin {
namespace {

constexpr double least_prominence_mm = 10;
constexpr double least_distance_mm = 60;
constexpr double plateau_mm = 2;  // the valley's floor: as deep as this

struct Second {
  int at = -1;
  double prominence = 0;
};

/// Best second apex on one side of the first (direction +1 or -1).
Second second_apex(const std::vector<double>& front, int first, int direction, double step) {
  Second best;
  double lowest = front[first];
  for (int i = first; i >= 0 && i < static_cast<int>(front.size()); i += direction) {
    if (!std::isfinite(front[i])) break;
    lowest = std::min(lowest, front[i]);
    const double prominence = front[i] - lowest;
    if (std::abs(i - first) * step >= least_distance_mm && prominence > best.prominence)
      best = {i, prominence};
  }
  return best;
}

/// Between two columns that of the one in front.
double height_at(const std::vector<double>& front, double column) {
  return std::max(front[static_cast<std::size_t>(std::floor(column))],
                  front[static_cast<std::size_t>(std::ceil(column))]);
}

}  // namespace

std::vector<double> front_profile(const std::vector<double>& fronts, int nx, int low, int high) {
  std::vector<double> profile(nx, -std::numeric_limits<double>::infinity());
  for (int k = low; k <= high; ++k)
    for (int i = 0; i < nx; ++i)
      profile[i] = std::max(profile[i], fronts[static_cast<std::size_t>(k) * nx + i]);
  return profile;
}

std::optional<Apices> find_apices(const std::vector<double>& front, double step) {
  if (front.empty()) return std::nullopt;
  const int first = static_cast<int>(std::max_element(front.begin(), front.end()) - front.begin());
  if (!std::isfinite(front[first])) return std::nullopt;
  const Second up = second_apex(front, first, +1, step);
  const Second down = second_apex(front, first, -1, step);
  const Second& best = up.prominence >= down.prominence ? up : down;
  if (best.prominence < least_prominence_mm) return std::nullopt;
  const auto finite = [](double value) { return std::isfinite(value); };
  const auto begin = std::find_if(front.begin(), front.end(), finite) - front.begin();
  const auto end = front.rend() - std::find_if(front.rbegin(), front.rend(), finite);
  Apices apices;
  apices.right = std::min(first, best.at);
  apices.left = std::max(first, best.at);
  apices.valley = cleft_between(front, apices.right, apices.left);
  const auto in_middle_third = [&](double column) {
    const double along = (column - begin + 0.5) / static_cast<double>(end - begin);
    return along > 1.0 / 3 && along < 2.0 / 3;
  };
  if (!in_middle_third(apices.valley) && !in_middle_third((apices.right + apices.left) / 2.0))
    return std::nullopt;  // a breast and an arm
  return apices;
}

double cleft_between(const std::vector<double>& front, int right, int left) {
  const double valley = valley_between(front, right, left), middle = (right + left) / 2.0;
  const double most = (left - right) / 6.0, aside = std::abs(valley - middle);
  const double halfway = (height_at(front, valley) + std::min(front[right], front[left])) / 2;
  if (aside <= most || height_at(front, middle) > halfway) return valley;
  return middle + std::copysign(std::max(0.0, 2 * most - aside), valley - middle);
}

double valley_between(const std::vector<double>& front, int low, int high) {
  double floor = std::numeric_limits<double>::infinity();
  for (int i = low; i <= high; ++i)
    if (std::isfinite(front[i])) floor = std::min(floor, front[i]);
  double sum = 0;
  int count = 0;
  for (int i = low; i <= high; ++i)
    if (std::isfinite(front[i]) && front[i] <= floor + plateau_mm) sum += i, ++count;
  return count > 0 ? sum / count : low;
}

}  // namespace mammotwin
