#include "registration/mammogram/mammogram_findings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "registration/mammogram/mammogram_masks.h"

namespace mammotwin {
namespace {

/// Skin stands out of air by this share of the brightest grey after a light blur.
constexpr double kAirShare = 0.03;
constexpr double kBlur = 2;  // [pixels]
/// A breast fills at least this share of its mammogram.
constexpr double kLeastBreast = 0.03;

/// The image with its chest wall on the left, so that one case remains.
class Upright {
 public:
  Upright(const MammogramImage& image, ImageEdge chest_wall) : image_(image), edge_(chest_wall) {}
  float at(int from_wall, int row) const { return image_.at(column(from_wall), row); }
  int column(int from_wall) const {
    return edge_ == ImageEdge::left ? from_wall : image_.columns - 1 - from_wall;
  }
  double column(double from_wall) const {
    return edge_ == ImageEdge::left ? from_wall : image_.columns - 1 - from_wall;
  }
  Eigen::Vector2d pixel(double from_wall, double row) const { return {column(from_wall), row}; }
  int columns() const { return image_.columns; }
  int rows() const { return image_.rows; }

 private:
  const MammogramImage& image_;
  ImageEdge edge_;
};

float brightest(const MammogramImage& image) {
  return *std::max_element(image.grey.begin(), image.grey.end());
}

std::vector<std::uint8_t> breast_mask(const MammogramImage& image) {
  const auto regions =
      regions_above(smoothed(image, kBlur), static_cast<float>(kAirShare * brightest(image)));
  std::vector<std::uint8_t> mask(regions.size());
  std::transform(regions.begin(), regions.end(), mask.begin(), [](auto r) { return r == 1; });
  const auto pixels = std::accumulate(mask.begin(), mask.end(), std::size_t{0});
  if (pixels < kLeastBreast * mask.size())
    throw std::runtime_error("no breast in the mammogram: the largest bright region fills " +
                             std::to_string(100 * pixels / mask.size()) + " % of it");
  return mask;
}

/// The vertical edge that more of the breast touches.
ImageEdge chest_wall_edge(const std::vector<std::uint8_t>& mask, int columns, int rows) {
  int left = 0, right = 0;
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < columns / 20; ++i) {
      left += mask[static_cast<std::size_t>(row) * columns + i];
      right += mask[static_cast<std::size_t>(row + 1) * columns - 1 - i];
    }
  return left >= right ? ImageEdge::left : ImageEdge::right;
}

/// Distance of the skin from the chest wall's edge in each row [pixels]; -1 where there is no
/// breast.
std::vector<int> skin_line(const std::vector<std::uint8_t>& mask, const Upright& image) {
  std::vector<int> skin(image.rows(), -1);
  for (int row = 0; row < image.rows(); ++row)
    for (int i = image.columns() - 1; i >= 0 && skin[row] < 0; --i)
      if (mask[static_cast<std::size_t>(row) * image.columns() + image.column(i)]) skin[row] = i;
  return skin;
}

struct Disc {
  int low_column = 1 << 30, high_column = -1, low_row = 1 << 30, high_row = -1, pixels = 0;
  int width() const { return high_column - low_column + 1; }
  int height() const { return high_row - low_row + 1; }
};

/// A marker is a saturated disc of 1 to 3 % of the image's width: 1.5 to 5 mm on usual detectors.
bool is_marker(const Disc& d, int columns) {
  const double size = std::max(d.width(), d.height());
  const double fill = d.pixels / (0.25 * M_PI * d.width() * d.height());
  return size > 0.01 * columns && size < 0.03 * columns &&
         std::abs(d.width() - d.height()) < 0.2 * size && fill > 0.9 && fill < 1.1;
}

std::optional<Eigen::Vector2d> find_marker(const MammogramImage& image) {
  constexpr double kSaturated = 0.98;
  const auto regions = regions_above(image, static_cast<float>(kSaturated * brightest(image)));
  std::vector<Disc> discs(*std::max_element(regions.begin(), regions.end()) + 1);
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column) {
      const auto region = regions[static_cast<std::size_t>(row) * image.columns + column];
      if (region == 0) continue;
      Disc& d = discs[region];
      d.low_column = std::min(d.low_column, column);
      d.high_column = std::max(d.high_column, column);
      d.low_row = std::min(d.low_row, row);
      d.high_row = std::max(d.high_row, row);
      ++d.pixels;
    }
  std::optional<Eigen::Vector2d> found;
  for (const Disc& d : discs)
    if (d.pixels > 0 && is_marker(d, image.columns)) {
      if (found) return std::nullopt;  // two of them: neither is surely the nipple's
      found = Eigen::Vector2d(d.low_column + d.high_column, d.low_row + d.high_row) / 2;
    }
  return found;
}

/// A straight edge: distance from the chest wall at the top row, and the row at which it meets the
/// chest wall's edge (below the image if it leaves at the bottom).
struct Edge {
  double top, end;
  double at(double row) const { return top * (1 - row / end); }
};

/// Mean brightness lost across the edge, `reach` pixels to either side.
double contrast(const Upright& image, const Edge& edge, int reach) {
  const int last = std::min<int>(image.rows() - 1, 0.9 * edge.end);
  double sum = 0;
  int count = 0;
  for (int row = 10; row < last; row += 8) {
    const int x = static_cast<int>(std::lround(edge.at(row)));
    if (x - reach < 0 || x + reach >= image.columns()) continue;
    sum += image.at(x - reach, row) - image.at(x + reach, row);
    ++count;
  }
  return count < 20 ? 0 : sum / count;
}

/// The line of greatest mean contrast, muscle being bright; lines to try are 4 pixels apart.
std::optional<Edge> pectoral_edge(const Upright& image, int skin_at_top, float full_grey) {
  constexpr double kLeastContrast = 0.04;  // of the brightest grey
  const int reach = image.columns() / 60;
  Edge best{0, 0};
  double most = kLeastContrast * full_grey;
  for (int top = image.columns() / 12; top < 0.9 * skin_at_top; top += 4)
    for (double end = 0.3 * image.rows(); end < 2.0 * image.rows(); end += 8) {
      const double c = contrast(image, {double(top), end}, reach);
      if (c > most) {
        most = c;
        best = {double(top), end};
      }
    }
  if (best.end == 0) return std::nullopt;
  return best;
}

/// Row of the skin's point farthest from the pectoral edge, or from the chest wall without one.
int farthest_row(const std::vector<int>& skin, const std::optional<Edge>& edge) {
  int row = 0;
  double most = -1;
  for (std::size_t r = 0; r < skin.size(); ++r) {
    const double across = edge ? edge->end / std::hypot(edge->top, edge->end) : 1;
    const double distance = skin[r] < 0 ? -1 : (skin[r] - (edge ? edge->at(r) : 0)) * across;
    if (distance > most) {
      most = distance;
      row = static_cast<int>(r);
    }
  }
  return row;
}

}  // namespace

MammogramFindings find_breast(const MammogramImage& image, bool oblique) {
  const auto mask = breast_mask(image);
  MammogramFindings found;
  found.chest_wall = chest_wall_edge(mask, image.columns, image.rows);
  const Upright upright(image, found.chest_wall);
  const std::vector<int> skin = skin_line(mask, upright);
  for (int row = 0; row < image.rows; ++row)
    if (skin[row] >= 0) found.outline.push_back(upright.pixel(skin[row], row));

  std::optional<Edge> edge;
  if (oblique) {
    const MammogramImage blurred = smoothed(image, image.columns / 200.0);
    edge =
        pectoral_edge(Upright(blurred, found.chest_wall), skin[image.rows / 100], brightest(image));
  }
  if (edge) {
    const double bottom = std::min<double>(image.rows - 1, edge->end);
    found.pectoral = {upright.pixel(edge->top, 0), upright.pixel(edge->at(bottom), bottom)};
  }
  if (const auto marker = find_marker(image)) {
    found.nipple = *marker;
    found.evidence = NippleEvidence::marker;
  } else {
    const int row = farthest_row(skin, edge);
    found.nipple = upright.pixel(skin[row], row);
  }
  return found;
}

}  // namespace mammotwin
