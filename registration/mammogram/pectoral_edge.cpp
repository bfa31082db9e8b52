#include "registration/mammogram/pectoral_edge.h"

#include <algorithm>
#include <cmath>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr double kStep_mm = 2;                         // between samples along a line
constexpr double kPiece_mm = 6;                        // of edge that is one observation
constexpr double kReach_mm = 3;                        // to either side
constexpr double kLeastAngle = 6, kMostAngle = 45;     // [deg] to the chest wall
constexpr double kUsualAngle = 22, kAngleSd = 8;       // [deg]; 6 among the radiologists' lines
constexpr double kAngleStep = 1.5, kTopStep_mm = 1.6;  // of the lines that are tried
constexpr double kLeastTop_mm = 8;
constexpr double kChance = 0.25;  // response of a piece of line anywhere in a breast
constexpr double kLeastEvidence = 2;
constexpr double kReadingSd_mm = 2;  // of one and the same edge read twice
/// Root mean square of errors over the sd that the spread of lines gives: pieces of an edge are
/// more independent than one in 6 mm. From every other one of 32 real views, by name.
constexpr double kErrorOverSpread = 0.7;

struct Line {
  double top_mm, tangent;
  Eigen::Vector2d at(double row) const { return {top_mm - row * tangent, row}; }
  Eigen::Vector2d outward() const { return Eigen::Vector2d(1, tangent).normalized(); }
  double stretch() const { return std::hypot(1, tangent); }
};

class EdgeResponse {
 public:
  EdgeResponse(const UprightImage& smooth, const MammogramImage& mask)
      : smooth_(smooth), mask_(mask), scale_(usual_change()) {}

  /// -1 to 1: how clearly it is brighter behind a place than before it; nothing where a side is not
  /// breast.
  std::optional<double> at(const Eigen::Vector2d& x, const Eigen::Vector2d& outward) const {
    const Eigen::Vector2d behind = x - kReach_mm * outward, before = x + kReach_mm * outward;
    if (behind.x() < 0 || behind.y() < 0 || !breast(behind) || !breast(before + outward))
      return std::nullopt;
    return std::tanh((smooth_.at(behind) - smooth_.at(before)) / scale_);
  }
  bool breast(const Eigen::Vector2d& x) const {
    const int column = static_cast<int>(x.x() / smooth_.pixel_mm());
    const int row = static_cast<int>(x.y() / smooth_.pixel_mm());
    return column >= 0 && row >= 0 && column < mask_.columns && row < mask_.rows &&
           mask_.at(column, row) > 0;
  }

 private:
  /// Twice the median change over the same reach anywhere in the breast.
  double usual_change() const {
    std::vector<double> changes;
    for (double row = kStep_mm; row < smooth_.height_mm(); row += kStep_mm)
      for (double depth = kReach_mm; depth < smooth_.depth_mm(); depth += kStep_mm) {
        const Eigen::Vector2d x(depth, row), reach(kReach_mm, 0);
        if (breast(x - reach) && breast(x + reach))
          changes.push_back(std::abs(smooth_.at(x - reach) - smooth_.at(x + reach)));
      }
    if (changes.empty()) return 1;
    return std::max(1e-6, 2 * median(changes));
  }

  const UprightImage& smooth_;
  const MammogramImage& mask_;
  double scale_;
};

/// Row at which a line leaves the image at the chest wall or the bottom.
double last_row(const Line& line, const UprightImage& image) {
  return std::min(line.top_mm / line.tangent, image.height_mm());
}

struct Scored {
  Line line;
  double evidence = -1e30, seen_to = 0;  ///< row
};

/// A line's evidence is the most that it gathers from the top down to any row: below, dense tissue
/// may hide it.
Scored scored(const Line& line, const EdgeResponse& response, const UprightImage& image) {
  Scored s{line};
  const double angle = std::atan(line.tangent) * 180 / M_PI;
  const double prior = -std::pow((angle - kUsualAngle) / kAngleSd, 2) / 2;
  double sum = prior;
  for (double row = kReach_mm; row < last_row(line, image); row += kStep_mm / line.stretch()) {
    const auto r = response.at(line.at(row), line.outward());
    if (!r && line.at(row).x() > 2 * kReach_mm) sum -= kChance * kStep_mm / kPiece_mm;
    if (r) sum += (*r - kChance) * kStep_mm / kPiece_mm;
    if (sum > s.evidence) {
      s.evidence = sum;
      s.seen_to = row;
    }
  }
  return s;
}

/// A line begins in the breast below the rows that a turned or collimated image leaves empty.
bool begins_in_breast(const Line& line, const EdgeResponse& response) {
  constexpr double kEmpty_mm = 15;
  for (double row = kReach_mm; row < kEmpty_mm; row += kStep_mm)
    if (response.breast(line.at(row))) return true;
  return false;
}

std::vector<Scored> all_lines(const EdgeResponse& response, const UprightImage& image) {
  std::vector<Scored> lines;
  for (double angle = kLeastAngle; angle <= kMostAngle; angle += kAngleStep)
    for (double top = kLeastTop_mm; top < image.depth_mm(); top += kTopStep_mm)
      if (begins_in_breast(Line{top, std::tan(angle * M_PI / 180)}, response))
        lines.push_back(scored({top, std::tan(angle * M_PI / 180)}, response, image));
  return lines;
}

/// Standard deviation across the best line, at its top and where it is last seen, of all lines.
double spread(const std::vector<Scored>& lines, const Scored& best) {
  double weights = 0, squares = 0;
  for (const Scored& s : lines) {
    const double weight = std::exp(s.evidence - best.evidence);
    weights += weight;
    for (const double row : {0., best.seen_to})
      squares += weight *
                 std::pow((s.line.at(row).x() - best.line.at(row).x()) / best.line.stretch(), 2) /
                 2;
  }
  return std::sqrt(squares / weights);
}

/// Offsets across the line of the most probable curve: dynamic programming over steps of offsets.
std::vector<Eigen::Vector2d> curved(const Scored& best, const EdgeResponse& response) {
  constexpr int kOffsets = 27;  // -7.8 to 7.8 mm
  constexpr double kOffset_mm = 0.6, kBend = 0.15;
  const Line& line = best.line;
  const int rows = std::max(2, static_cast<int>(best.seen_to * line.stretch() / kStep_mm) + 1);
  const auto place = [&](int n, int offset) -> Eigen::Vector2d {
    return line.at(n * kStep_mm / line.stretch()) +
           (offset - kOffsets / 2) * kOffset_mm * line.outward();
  };
  std::vector<std::array<double, kOffsets>> sum(rows);
  std::vector<std::array<int, kOffsets>> from(rows);
  for (int n = 0; n < rows; ++n)
    for (int o = 0; o < kOffsets; ++o) {
      sum[n][o] = -1e30;
      const double here = response.at(place(n, o), line.outward()).value_or(0);
      for (int p = std::max(0, o - 1); p <= std::min(kOffsets - 1, o + 1); ++p) {
        const double before = n == 0 ? (p == o ? 0 : -1e30) : sum[n - 1][p];
        const double now = before + (here - kBend * std::abs(p - o)) * kStep_mm / kPiece_mm;
        if (now > sum[n][o]) {
          sum[n][o] = now;
          from[n][o] = p;
        }
      }
    }
  int o =
      static_cast<int>(std::max_element(sum.back().begin(), sum.back().end()) - sum.back().begin());
  std::vector<Eigen::Vector2d> points(rows);
  for (int n = rows - 1; n >= 0; --n) {
    points[n] = place(n, o);
    o = from[n][o];
  }
  return points;
}

}  // namespace

std::optional<PectoralEdge> pectoral_edge(const UprightImage& smooth, const MammogramImage& mask) {
  const EdgeResponse response(smooth, mask);
  const std::vector<Scored> lines = all_lines(response, smooth);
  const auto best =
      std::max_element(lines.begin(), lines.end(),
                       [](const Scored& a, const Scored& b) { return a.evidence < b.evidence; });
  if (best == lines.end() || best->evidence < kLeastEvidence) return std::nullopt;
  PectoralEdge edge;
  edge.points = curved(*best, response);
  edge.top = best->line.at(0);
  edge.end = best->line.at(last_row(best->line, smooth));
  edge.sd_mm = kErrorOverSpread * std::hypot(kReadingSd_mm, spread(lines, *best));
  edge.evidence = best->evidence;
  return edge;
}

}  // namespace mammotwin
