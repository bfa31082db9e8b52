#include "registration/mammogram/nipple_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr double kAlongSkin_mm = 0.5;
constexpr double kNear_mm = 7, kFar_mm = 22;  // flanks of a nipple of up to 14 mm
constexpr double kLeastFlank = 0.6;           // of their points that must be there on either side

std::vector<Eigen::Vector2d> evenly(const std::vector<Eigen::Vector2d>& line) {
  constexpr int kMean = 2;  // points to either side: the line runs along pixels' borders
  std::vector<Eigen::Vector2d> smooth(line.size());
  for (int i = 0; i < static_cast<int>(line.size()); ++i) {
    const int reach = std::min({kMean, i, static_cast<int>(line.size()) - 1 - i});
    smooth[i] = Eigen::Vector2d::Zero();
    for (int j = i - reach; j <= i + reach; ++j) smooth[i] += line[j] / (2 * reach + 1);
  }
  std::vector<Eigen::Vector2d> even{smooth.front()};
  double left = kAlongSkin_mm;
  for (std::size_t i = 1; i < smooth.size(); ++i) {
    const Eigen::Vector2d way = smooth[i] - smooth[i - 1];
    const double length = way.norm();
    double gone = left;
    for (; gone <= length; gone += kAlongSkin_mm)
      even.push_back(smooth[i - 1] + way * (gone / length));
    left = gone - length;
  }
  return even;
}

// Where along the skin, as a share of its length, and what a sign of it is worth: from every other
// one of 32 real views.
constexpr double kShareCc = 0.52, kShareMlo = 0.65, kShareSd = 0.07;
constexpr double kLeastDepth = 0.5;  // of the breast's: nearer to the chest wall no nipple is
constexpr double kBulgeWorth = 4, kMostBulge_mm = 3;  // log-likelihood per mm
constexpr double kGlowWorth = 0.35, kMostGlow = 12;   // per standard deviation
constexpr double kProfile_mm = 1;                     // a bulge of a nipple in profile
// Of the reading itself: a tip in profile, or a disc somewhere behind the skin.
constexpr double kTipSd_mm = 1.5, kFlatSd_mm = 4;
constexpr double kHalfNipple_mm = 3;  // likelihood within it belongs to one candidate
constexpr double kLeastProbability = 0.05;

/// Indices of both flanks of point i; empty where too little of either is there.
std::vector<int> flanks(int i, int size) {
  const int near = std::lround(kNear_mm / kAlongSkin_mm),
            far = std::lround(kFar_mm / kAlongSkin_mm);
  const int least = static_cast<int>(near + kLeastFlank * (far - near));
  if (i < least || i + least >= size) return {};
  std::vector<int> found;
  for (int j = std::max(0, i - far); j <= std::min(size - 1, i + far); ++j)
    if (std::abs(j - i) >= near) found.push_back(j);
  return found;
}

/// Value at 0 of the parabola through (x, y) by least squares.
double parabola_at_zero(const std::vector<double>& x, const std::vector<double>& y) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Eigen::Vector3d row(1, x[n], x[n] * x[n]);
    normal += row * row.transpose();
    right += row * y[n];
  }
  return normal.ldlt().solve(right)[0];
}

/// Outward direction between a point's flanks; the skin runs down, outwards is left of its way.
Eigen::Vector2d outward(const std::vector<Eigen::Vector2d>& p, const std::vector<int>& flank) {
  const Eigen::Vector2d way = (p[flank.back()] - p[flank.front()]).normalized();
  return {way.y(), -way.x()};
}

double bulge(const std::vector<Eigen::Vector2d>& p, int i, const std::vector<int>& flank) {
  const Eigen::Vector2d out = outward(p, flank), along(-out.y(), out.x());
  std::vector<double> x, y;
  for (const int j : flank) {
    x.push_back(along.dot(p[j] - p[i]));
    y.push_back(out.dot(p[j] - p[i]));
  }
  return -parabola_at_zero(x, y);
}

/// Mean brightness 1 to 8 mm inside the skin.
double inside(const UprightImage& image, const Eigen::Vector2d& x, const Eigen::Vector2d& out) {
  constexpr double kFirst_mm = 1, kLast_mm = 8;
  double sum = 0;
  int count = 0;
  for (double depth = kFirst_mm; depth <= kLast_mm; depth += kAlongSkin_mm, ++count)
    sum += image.at(x - depth * out);
  return sum / count;
}

/// Each value over what its flanks' parabola gives, in standard deviations of all such differences.
std::vector<double> over_flanks(const std::vector<double>& values) {
  std::vector<double> over(values.size(), 0), sizes;
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    const std::vector<int> flank = flanks(i, values.size());
    if (flank.empty()) continue;
    std::vector<double> x, y;
    for (const int j : flank) {
      x.push_back((j - i) * kAlongSkin_mm);
      y.push_back(values[j]);
    }
    over[i] = values[i] - parabola_at_zero(x, y);
    sizes.push_back(std::abs(over[i]));
  }
  if (sizes.empty()) return over;
  const double sd = std::max(1e-9, 1.4826 * median(sizes));  // of a normal distribution
  for (double& o : over) o /= sd;
  return over;
}

/// Of each point, that it is the nipple; they sum to 1.
std::vector<double> probabilities(const NippleProfile& profile, bool oblique) {
  const int size = static_cast<int>(profile.points.size());
  std::vector<double> p(size);
  double deepest = 0;
  for (const Eigen::Vector2d& x : profile.points) deepest = std::max(deepest, x.x());
  for (int i = 0; i < size; ++i) {
    const double z = ((i + 0.5) / size - (oblique ? kShareMlo : kShareCc)) / kShareSd;
    p[i] = -z * z / 2 + kBulgeWorth * std::clamp(profile.bulge_mm[i], 0., kMostBulge_mm) +
           kGlowWorth * std::clamp(profile.glow[i], 0., kMostGlow);
  }
  const double most = *std::max_element(p.begin(), p.end());
  for (int i = 0; i < size; ++i)
    p[i] = profile.points[i].x() < kLeastDepth * deepest ? 0 : std::exp(p[i] - most);
  const double sum = std::accumulate(p.begin(), p.end(), 0.);
  for (double& x : p) x /= sum;
  return p;
}

std::vector<double> within_a_nipple(const std::vector<double>& p) {
  const int reach = std::lround(kHalfNipple_mm / kAlongSkin_mm), size = static_cast<int>(p.size());
  std::vector<double> sum(size, 0);
  for (int i = 0; i < size; ++i)
    for (int j = std::max(0, i - reach); j <= std::min(size - 1, i + reach); ++j) sum[i] += p[j];
  return sum;
}

/// The point of most bulge within half a nipple.
std::size_t tip_index(const NippleProfile& profile, std::size_t i) {
  const std::size_t reach = std::lround(kHalfNipple_mm / kAlongSkin_mm);
  const auto& b = profile.bulge_mm;
  const auto begin = b.begin() + (i < reach ? 0 : i - reach);
  const std::size_t tip =
      std::max_element(begin, b.begin() + std::min(b.size(), i + reach + 1)) - b.begin();
  return b[tip] > kProfile_mm ? tip : i;
}

/// Root mean square distance of what is likely beyond the nipple that a place belongs to: within it
/// the tip is found better than likelihood, which is as wide as a nipple, says.
double spread(const NippleProfile& profile, const std::vector<double>& p,
              const Eigen::Vector2d& place) {
  double squares = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double distance = (profile.points[i] - place).norm();
    if (distance > kNear_mm) squares += p[i] * distance * distance;
  }
  return std::sqrt(squares);
}

NippleCandidate candidate(const NippleProfile& profile, std::size_t i, double probability) {
  const std::size_t tip = tip_index(profile, i);
  return {profile.points[tip], probability, profile.bulge_mm[tip]};
}

}  // namespace

NippleProfile nipple_profile(const SkinLine& skin, const UprightImage& smooth) {
  NippleProfile profile;
  profile.points = evenly(skin.points);
  const auto& p = profile.points;
  const int size = static_cast<int>(p.size());
  if (size * kAlongSkin_mm < 2 * kFar_mm) throw std::runtime_error("the skin line is too short");
  std::vector<double> bright(size, 0);
  profile.bulge_mm.assign(size, 0);
  std::optional<int> first, last;
  for (int i = 0; i < size; ++i) {
    const std::vector<int> flank = flanks(i, size);
    if (flank.empty()) continue;
    profile.bulge_mm[i] = bulge(p, i, flank);
    bright[i] = inside(smooth, p[i], outward(p, flank));
    if (!first) first = i;
    last = i;
  }
  for (int i = 0; first && i < *first; ++i) bright[i] = bright[*first];
  for (int i = size - 1; last && i > *last; --i) bright[i] = bright[*last];
  profile.glow = over_flanks(bright);
  return profile;
}

NippleFinding find_nipple(const NippleProfile& profile, bool oblique) {
  const std::vector<double> p = probabilities(profile, oblique);
  const std::vector<double> mass = within_a_nipple(p);
  NippleFinding found;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const std::size_t reach = std::lround(2 * kHalfNipple_mm / kAlongSkin_mm);
    const auto begin = mass.begin() + (i < reach ? 0 : i - reach);
    const auto end = mass.begin() + std::min(mass.size(), i + reach + 1);
    if (mass[i] >= kLeastProbability &&
        static_cast<std::size_t>(std::max_element(begin, end) - mass.begin()) == i)
      found.candidates.push_back(candidate(profile, i, mass[i]));
  }
  if (found.candidates.empty()) {
    const std::size_t i = std::max_element(mass.begin(), mass.end()) - mass.begin();
    found.candidates.push_back(candidate(profile, i, mass[i]));
  }
  std::stable_sort(found.candidates.begin(), found.candidates.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
  const NippleCandidate& best = found.candidates.front();
  found.in_profile = best.bulge_mm > kProfile_mm;
  const double reading = found.in_profile ? kTipSd_mm : kFlatSd_mm;
  found.sd_mm = std::hypot(reading, spread(profile, p, best.place));
  return found;
}

}  // namespace mammotwin
