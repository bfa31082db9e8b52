#include "registration/mammogram/skin_line.h"

#include <algorithm>
#include <stdexcept>

#include "registration/mammogram/mammogram_masks.h"
#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kValley_mm = 3, kHollow_mm = 4;
constexpr double kLeastSkin_mm = 30;
constexpr double kEdge_mm = 2;  // of the image: dark lines along an edge are no air

/// The longest part of a closed border that is off the image's edges, in pixels.
Points free_part(const Points& border, const MammogramImage& mask, double pixel_mm) {
  const double edge = kEdge_mm / pixel_mm;
  const auto free = [&](const Eigen::Vector2d& x) {
    return x.x() > edge && x.y() > edge && x.y() < mask.rows - 1 - edge;
  };
  const std::size_t n = border.size();
  const auto held = std::find_if_not(border.begin(), border.end(), free);
  const std::size_t first = held == border.end() ? 0 : held - border.begin();
  Points longest, now;
  for (std::size_t i = 0; i <= n; ++i) {
    const Eigen::Vector2d& x = border[(first + i) % n];
    if (i < n && free(x)) {
      now.push_back(x);
      continue;
    }
    if (now.size() > longest.size()) longest = now;
    now.clear();
  }
  return longest;
}

long deepest(const Points& line) {
  return std::max_element(line.begin(), line.end(),
                          [](const auto& a, const auto& b) { return a.x() < b.x(); }) -
         line.begin();
}

/// Index from `tip` towards `end` (exclusive, step 1 or -1) at which depth has its least before it
/// rises by a valley's height; `end` where it does not.
long valley(const Points& line, long tip, long end, int step) {
  long least = tip;
  for (long i = tip; i != end; i += step) {
    if (line[i].x() < line[least].x()) least = i;
    if (line[i].x() > line[least].x() + kValley_mm && line[least].x() < line[tip].x() / 2)
      return least;
  }
  return end;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The point that lies deepest behind a chord from any point after the tip to the line's end, which
/// is farther from it than a nipple reaches; `end` where nothing lies 4 mm behind: there a breast
/// is convex.
long hollow(const Points& line, long tip, long end, int step) {
  constexpr double kNear_mm = 40;    // of the line's end: farther out it is the nipple's flank
  constexpr double kNipple_mm = 30;  // a nipple that stands out 10 mm makes a hollow so wide
  constexpr int kStride = 4;         // of the points that chords begin at
  const Eigen::Vector2d last = line[end - step];
  long deepest = end;
  double most = kHollow_mm;
  for (long a = tip; step * (end - a) > kStride; a += kStride * step) {
    const Eigen::Vector2d chord = last - line[a];
    for (long i = a; i != end && chord.norm() > kHollow_mm; i += step) {
      const double behind = step * cross(chord, line[i] - line[a]) / chord.norm();
      if (behind < most || (line[i] - last).norm() > kNear_mm ||
          (line[i] - line[a]).norm() < kNipple_mm)
        continue;
      most = behind;
      deepest = i;
    }
  }
  return deepest;
}

/// The corner, in the half of the depth that is nearer to the chest wall, in which the line turns
/// most into the body, 6 mm or more behind a chord over it: abdomen that does not rise again behind
/// a fold; `end` where there is none.
long corner(const Points& line, long tip, long end, int step) {
  constexpr double kBefore_mm = 40, kAfter_mm = 25, kCorner_mm = 6;
  long deepest = end, a = tip, b = tip;
  double most = kCorner_mm;
  std::vector<double> along(line.size(), 0);
  for (long i = tip + step; i != end; i += step)
    along[i] = along[i - step] + (line[i] - line[i - step]).norm();
  for (long i = tip; i != end; i += step) {
    while (along[i] - along[a] > kBefore_mm) a += step;
    while (b + step != end && along[b] - along[i] < kAfter_mm) b += step;
    if (along[b] - along[i] < kAfter_mm) break;
    const Eigen::Vector2d chord = line[b] - line[a];
    const double behind = step * cross(chord, line[i] - line[a]) / std::max(chord.norm(), 1.);
    if (line[i].x() > line[tip].x() / 2 || behind <= most) continue;
    most = behind;
    deepest = i;
  }
  return deepest;
}

/// Spread of a line about its running mean over 15 mm, across the line, by quantiles that a nipple
/// does not move.
double roughness(const Points& line) {
  constexpr double kSmooth_mm = 15, kSdOfMad = 1.4826;
  std::vector<double> along{0};
  for (std::size_t n = 1; n < line.size(); ++n)
    along.push_back(along.back() + (line[n] - line[n - 1]).norm());
  std::vector<double> off;
  std::size_t first = 0, last = 0;
  Eigen::Vector2d sum(0, 0);
  for (std::size_t n = 0; n < line.size(); ++n) {
    for (; last < line.size() && along[last] < along[n] + kSmooth_mm / 2; ++last) sum += line[last];
    for (; along[first] < along[n] - kSmooth_mm / 2; ++first) sum -= line[first];
    const double count = static_cast<double>(last - first);
    off.push_back((line[n] - sum / count).norm());
  }
  return kSdOfMad * median(off);
}

}  // namespace

SkinLine skin_line(const MammogramImage& mask, double pixel_mm, bool oblique) {
  Points border;
  for (const auto& [column, row] : longest_border(mask)) border.emplace_back(column, row);
  Points line = free_part(border, mask, pixel_mm);
  if (line.size() * pixel_mm < kLeastSkin_mm)
    throw std::runtime_error("no skin line is seen: the bright region ends at the image's edges");
  for (Eigen::Vector2d& x : line) x = (x + Eigen::Vector2d(0.5, 0.5)) * pixel_mm;
  if (line.front().y() > line.back().y()) std::reverse(line.begin(), line.end());

  SkinLine skin;
  const auto cut = [&](long found, long end, const char* what) {
    if (found != end) skin.remarks.push_back(what);
    return found;
  };
  const long tip = deepest(line), size = static_cast<long>(line.size());
  long last =
      cut(valley(line, tip, size, 1), size, "below the breast a fold or the abdomen is cut off");
  last = cut(corner(line, tip, last, 1), last,
             "below the breast the abdomen is cut off at a corner of the skin");
  last = cut(hollow(line, tip, last, 1), last, "a fold at the breast's lower end is cut off");
  long before = cut(valley(line, tip, -1, -1), -1, "above the breast the arm or axilla is cut off");
  if (!oblique)
    before =
        cut(hollow(line, tip, before, -1), before, "a fold at the breast's upper end is cut off");
  skin.points.assign(line.begin() + before + 1, line.begin() + last);
  skin.roughness_mm = roughness(skin.points);
  return skin;
}

}  // namespace mammotwin
