#include "segmentation/body/lone_breast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "segmentation/body/apices.h"

namespace mammotwin {
namespace {

constexpr double least_standing_mm = 20, flank_deeper_mm = 10, least_half_mm = 30;
constexpr double widest_half_mm = 240;  // of skin; of one patient 340, of half of her image 190
constexpr double falls_within_mm = 6, falls_by_mm = 3;

/// Deepest skin of some columns; minus infinity where the skin ends.
double deepest(const std::vector<double>& front, int low, int high) {
  double deepest = std::numeric_limits<double>::infinity();
  for (int i = low; i <= high; ++i) deepest = std::min(deepest, front[i]);
  return deepest;
}

/// The columns with skin.
struct Skin {
  int first = 0, last = 0;
  double middle() const { return (first + last) / 2.0; }
};

Skin skin_of(const std::vector<double>& front) {
  const auto has_skin = [](double value) { return std::isfinite(value); };
  return {
      static_cast<int>(std::find_if(front.begin(), front.end(), has_skin) - front.begin()),
      static_cast<int>(front.rend() - std::find_if(front.rbegin(), front.rend(), has_skin)) - 1};
}

/// Of an image of half the chest; empty where neither side falls back further than the other.
std::optional<Side> side_of_half(const std::vector<double>& front, int apex) {
  const double low_x = deepest(front, 0, apex),
               high_x = deepest(front, apex, static_cast<int>(front.size()) - 1);
  if (!(std::abs(low_x - high_x) >= flank_deeper_mm)) return std::nullopt;
  return high_x < low_x ? Side::left : Side::right;
}

}  // namespace

std::optional<LoneBreast> find_lone_breast(const Volume<std::uint8_t>& body) {
  const std::vector<double> front =
      front_profile(column_fronts(body, [&](int i, int j, int k) { return body(i, j, k) != 0; }),
                    body.size.x(), 0, body.size.z() - 1);
  const int last = body.size.x() - 1;
  const int apex = static_cast<int>(std::max_element(front.begin(), front.end()) - front.begin());
  if (!std::isfinite(front[apex])) return std::nullopt;
  const Skin skin = skin_of(front);
  const bool whole_chest = (skin.last - skin.first) * body.spacing.x() > widest_half_mm;
  const std::optional<Side> side =
      whole_chest ? apex > skin.middle() ? Side::left : Side::right : side_of_half(front, apex);
  if (!side) return std::nullopt;
  const bool left = *side == Side::left;
  const double column =
      whole_chest ? skin.middle() : valley_between(front, left ? 0 : apex, left ? apex : last);
  const double breastbone = front[static_cast<std::size_t>(std::lround(column))];
  if (front[apex] - breastbone < least_standing_mm ||
      std::abs(column - apex) * body.spacing.x() < least_half_mm)
    return std::nullopt;
  LoneBreast lone{*side, body.origin.x() + column * body.spacing.x()};
  if (whole_chest) return lone;
  const int inward = static_cast<int>(std::lround(falls_within_mm / body.spacing.x()));
  const int edge = left ? 0 : last,
            beside = left ? std::min(last, inward) : std::max(0, last - inward);
  lone.is_cut = front[beside] - front[edge] > falls_by_mm;
  return lone;
}

template <class T>
Volume<T> with_mirror_image(const Volume<T>& image, const LoneBreast& lone) {
  const bool left = lone.side == Side::left;
  const double at = (lone.breastbone_x - image.origin.x()) / image.spacing.x();
  const int first = left ? std::max(0, static_cast<int>(std::ceil(at))) : 0;
  const int last =
      left ? image.size.x() - 1 : std::min(image.size.x() - 1, static_cast<int>(std::floor(at)));
  const int half = last - first + 1;
  if (half < 1) throw std::runtime_error("the image ends beside the breastbone");
  Eigen::Vector3d origin = image.origin;
  if (left) origin.x() += (first - half) * image.spacing.x();
  Volume<T> both({2 * half, image.size.y(), image.size.z()}, image.spacing, origin);
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < half; ++i) {
        const T value = image(first + i, j, k);
        both(left ? half + i : i, j, k) = value;
        both(left ? half - 1 - i : 2 * half - 1 - i, j, k) = value;
      }
  return both;
}

template Volume<float> with_mirror_image(const Volume<float>&, const LoneBreast&);
template Volume<std::uint8_t> with_mirror_image(const Volume<std::uint8_t>&, const LoneBreast&);

}  // namespace mammotwin
