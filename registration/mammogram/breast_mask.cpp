#include "registration/mammogram/breast_mask.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "registration/mammogram/mammogram_masks.h"
#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

/// Skin stands out of air by so many of air's standard deviations; and by a share of the range of
/// greys: exports round to 256 greys, so a spread can be nought.
constexpr double kAirSpreads = 9;
constexpr double kThin_mm = 2;
constexpr double kLeastBreast = 0.03, kMostBreast = 0.9;  // of the image
/// More of the image's rows with skin on the far edge: that is no skin.
constexpr double kMostCut = 0.05;
/// Air of an exposed field is looked for so often above darker frames.
constexpr int kMostFrames = 3;

/// Share of a line of pixels that is as bright as anything.
template <class At>
bool is_white(int count, float white, At at) {
  constexpr double kNearlyAll = 0.95;
  int bright = 0;
  for (int i = 0; i < count; ++i) bright += at(i) >= white;
  return bright > kNearlyAll * count;
}

struct Extent {
  std::size_t pixels = 0;
  int at_left = 0, at_right = 0;  ///< rows in which it touches
  int edge() const { return std::max(at_left, at_right); }
};

Extent extent_of(const MammogramImage& mask) {
  Extent e;
  for (const float m : mask.grey) e.pixels += m > 0;
  const int margin = mask.columns / 100;  // a dark line along the edge is no gap
  for (int row = 0; row < mask.rows; ++row) {
    bool left = false, right = false;
    for (int i = 0; i <= margin; ++i) {
      left |= mask.at(i, row) > 0;
      right |= mask.at(mask.columns - 1 - i, row) > 0;
    }
    e.at_left += left;
    e.at_right += right;
  }
  return e;
}

/// Of the regions above a threshold the one that fills most among those at an edge.
MammogramImage region_at_edge(const MammogramImage& image, float threshold, int radius) {
  MammogramImage bright = image;
  for (float& grey : bright.grey) grey = grey > threshold;
  const auto regions = regions_above(opened(bright, radius), 0.5f);
  MammogramImage mask{image.columns, image.rows, std::vector<float>(image.grey.size())};
  for (std::uint32_t region = 1; region <= 3; ++region) {  // labels and tape are smaller
    for (std::size_t i = 0; i < regions.size(); ++i) mask.grey[i] = regions[i] == region;
    if (extent_of(mask).edge() > kLeastBreast * image.rows) return mask;
  }
  return mask;
}

/// What is dark and enclosed by the breast is breast.
void fill_holes(MammogramImage& mask) {
  MammogramImage outside = mask;
  for (float& m : outside.grey) m = 1 - m;
  const auto regions = regions_above(outside, 0.5f);
  std::vector<bool> open(*std::max_element(regions.begin(), regions.end()) + 1, false);
  const auto see = [&](int column, int row) {
    open[regions[static_cast<std::size_t>(row) * mask.columns + column]] = true;
  };
  for (int r = 0; r < mask.rows; ++r) {
    see(0, r);
    see(mask.columns - 1, r);
  }
  for (int c = 0; c < mask.columns; ++c) {
    see(c, 0);
    see(c, mask.rows - 1);
  }
  for (std::size_t i = 0; i < mask.grey.size(); ++i)
    if (regions[i] > 0 && !open[regions[i]]) mask.grey[i] = 1;
}

/// Empty where a mask is like a breast; else what is wrong with it.
std::string fault_of(const MammogramImage& mask) {
  const Extent e = extent_of(mask);
  const double share = static_cast<double>(e.pixels) / mask.grey.size();
  const std::string fills = std::to_string(static_cast<int>(100 * share)) + " % of the image";
  if (share < kLeastBreast) return "the largest bright region at an edge fills " + fills;
  if (share > kMostBreast) return "what is brighter than air fills " + fills;
  if (std::min(e.at_left, e.at_right) > kMostCut * mask.rows)
    return "what is brighter than air reaches both sides of the image";
  return "";
}

/// Enough of the image is brighter than `floor` to hold air and a breast.
bool has_more_than(float floor, const MammogramImage& image) {
  const auto above =
      std::count_if(image.grey.begin(), image.grey.end(), [&](float grey) { return grey > floor; });
  return above > kLeastBreast * image.grey.size();
}

}  // namespace

void paint_over_borders(MammogramImage& image) {
  constexpr double kWhite = 0.97, kMostBorder = 0.1;
  constexpr int kBlurred = 2;  // lines between white and image that are neither
  const auto [low, high] = std::minmax_element(image.grey.begin(), image.grey.end());
  const float white = static_cast<float>(*low + kWhite * (*high - *low));
  const auto column = [&](int c) {
    return is_white(image.rows, white, [&](int r) { return image.at(c, r); });
  };
  const auto row = [&](int r) {
    return is_white(image.columns, white, [&](int c) { return image.at(c, r); });
  };
  const auto copy_column = [&](int to, int from) {
    for (int r = 0; r < image.rows; ++r) image.at(to, r) = image.at(from, r);
  };
  const auto copy_row = [&](int to, int from) {
    for (int c = 0; c < image.columns; ++c) image.at(c, to) = image.at(c, from);
  };
  // Lines from one edge inwards; `line` numbers them from it.
  const auto paint = [&](int size, const auto& is_border, const auto& copy, const auto& line) {
    int wide = 0;
    while (wide < kMostBorder * size && is_border(line(wide))) ++wide;
    if (wide == 0) return;
    const int inside = std::min(size - 1, wide + kBlurred);
    for (int n = 0; n < inside; ++n) copy(line(n), line(inside));
  };
  paint(image.columns, column, copy_column, [](int n) { return n; });
  paint(image.columns, column, copy_column, [&](int n) { return image.columns - 1 - n; });
  paint(image.rows, row, copy_row, [](int n) { return n; });
  paint(image.rows, row, copy_row, [&](int n) { return image.rows - 1 - n; });
}

namespace {

/// Median and spread of values, which must not be empty and are changed.
AirLevel level_of(std::vector<float>& values) {
  constexpr double kSdOfMad = 1.4826;  // of a normal distribution
  AirLevel air;
  air.grey = median(values);
  for (float& grey : values) grey = std::abs(grey - air.grey);
  air.spread = static_cast<float>(kSdOfMad * median(values));
  return air;
}

}  // namespace

AirLevel air_level(const MammogramImage& image, float floor, double least_share) {
  constexpr int kMostSplits = 3;
  MammogramImage part{0, 1, {}};
  for (const float grey : image.grey)
    if (grey > floor) part.grey.push_back(grey);
  if (part.grey.empty()) throw std::runtime_error("no air is seen beside the breast");
  const auto [low, high] = std::minmax_element(part.grey.begin(), part.grey.end());
  const float range = *high - *low;
  if (!(range > 0)) throw std::runtime_error("all of the image has one grey");
  std::optional<AirLevel> first;
  for (int split = 0; split < kMostSplits; ++split) {
    part.columns = static_cast<int>(part.grey.size());
    const float otsu = otsu_threshold(part);
    std::erase_if(part.grey, [otsu](float grey) { return grey > otsu; });
    std::vector<float> dark = part.grey;
    AirLevel air = level_of(dark);
    const float skin =
        air.grey + static_cast<float>(std::max(kAirSpreads * air.spread, least_share * range));
    air.threshold = std::min(otsu, skin);
    if (skin < otsu) return air;
    if (!first) first = air;
    if (*std::min_element(part.grey.begin(), part.grey.end()) == otsu) break;
  }
  return *first;
}

MammogramImage breast_mask(const MammogramImage& image, double pixel_mm, double least_share) {
  float floor = -std::numeric_limits<float>::infinity();
  std::string fault;
  for (int frame = 0; frame < kMostFrames && has_more_than(floor, image); ++frame) {
    const AirLevel air = air_level(image, floor, least_share);
    MammogramImage mask =
        region_at_edge(image, air.threshold, std::max(1L, std::lround(kThin_mm / 2 / pixel_mm)));
    const std::string now = fault_of(mask);
    if (now.empty()) {
      fill_holes(mask);
      return mask;
    }
    if (fault.empty()) fault = now;
    floor = air.threshold;
  }
  throw std::runtime_error(fault +
                           ": no breast's outline is seen; expected a bright breast at the left or "
                           "right edge with dark air before it. Is it a crop, or inverted? "
                           "views.cc.outline (views.mlo.outline) can say it");
}

}  // namespace mammotwin
