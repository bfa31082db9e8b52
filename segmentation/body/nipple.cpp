#include "segmentation/body/nipple.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "segmentation/body/most_anterior_point.h"
#include "segmentation/body/skin_look.h"
#include "segmentation/image/components.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/mirrored.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Mask = Volume<std::uint8_t>;

constexpr double ball_mm = 9;     // a papilla is 10 to 14 mm wide
constexpr double least_mm = 1.5;  // over the ball: less is the outline's own unevenness
constexpr double least_ml = 0.08, most_ml = 3;
constexpr double tip_mm = 1;         // the tip is the middle of what stands out as far as this
constexpr double same_place_mm = 8;  // a papilla's tip from the place of the best sum
constexpr double most_papilla = 6;   // of a sum, in which its height counts [mm]
constexpr double nearness_mm = 25;   // to the most anterior point
constexpr double reach_mm = 60;      // what lies farther off is not looked at
constexpr double beyond_mm = 20;     // of the crop: what smoothing reaches
constexpr double off_edge_mm = 5, off_midline_mm = 15;  // of the region: labels end there
constexpr double least_evidence = 5;
constexpr double apart_mm = 12;      // between candidates
constexpr double at_best_sd_mm = 2;  // of the place of one candidate
constexpr double not_found_sd_mm = 25;
constexpr std::size_t most_candidates = 6;

struct Near {
  Mask body;
  Volume<float> look;
};

Near cut_near(const Mask& labels, const Volume<float>& look, const Vector3d& x) {
  const Vector3d reach = Vector3d::Constant(reach_mm + beyond_mm);
  const Vector3i low = labels.index(x - reach).array().ceil().max(0).cast<int>();
  const Vector3i high = labels.index(x + reach)
                            .array()
                            .floor()
                            .min((labels.size.array() - 1).cast<double>())
                            .cast<int>();
  Near near{cropped(labels, low, high), cropped(look, low, high)};
  for (std::uint8_t& value : near.body.values) value = value != label::air;
  return near;
}

/// Away from where the labels end.
bool is_well_inside(const BreastRegion& r, const Vector3d& x) {
  const double left = r.side == Side::left ? off_midline_mm : off_edge_mm;
  const double right = r.side == Side::left ? off_edge_mm : off_midline_mm;
  return x.x() > r.x_min + left && x.x() < r.x_max - right && x.z() > r.z_min + off_edge_mm &&
         x.z() < r.z_max - off_edge_mm;
}

struct Bump {
  double height = 0;
  std::size_t voxels = 0;
  Vector3d tip = Vector3d::Zero();
  int at_tip = 0;
};

/// Height, size and tip of each part that stands out.
std::vector<Bump> measure(const Components& parts, const Volume<float>& height) {
  std::vector<Bump> bumps(parts.sizes.size());
  for (std::size_t v = 0; v < height.values.size(); ++v)
    if (const int id = parts.ids.values[v]; id > 0)
      bumps[id].height = std::max<double>(bumps[id].height, height.values[v]), ++bumps[id].voxels;
  for (int k = 0; k < height.size.z(); ++k)
    for (int j = 0; j < height.size.y(); ++j)
      for (int i = 0; i < height.size.x(); ++i)
        if (const int id = parts.ids(i, j, k); id > 0)
          if (Bump& bump = bumps[id]; height(i, j, k) > bump.height - tip_mm)
            bump.tip += height.position(i, j, k), ++bump.at_tip;
  for (Bump& bump : bumps)
    if (bump.at_tip > 0) bump.tip /= bump.at_tip;
  return bumps;
}

/// Parts of a body that an opening by a ball takes away, as high and large as a papilla may be.
struct StandingOut {
  Components parts;
  std::vector<Bump> bumps;  ///< by part
  std::vector<int> as_papilla;

  explicit StandingOut(const Mask& body) {
    const Mask smooth = opened(body, ball_mm);
    auto standing = body;
    for (std::size_t v = 0; v < standing.values.size(); ++v)
      standing.values[v] = body.values[v] && !smooth.values[v];
    parts = connected_components(standing);
    bumps = measure(parts, distance_to(smooth));
    for (int id = 1; id < static_cast<int>(bumps.size()); ++id) {
      const double ml = static_cast<double>(bumps[id].voxels) * body.voxel_volume() / 1000;
      if (bumps[id].height >= least_mm && ml >= least_ml && ml <= most_ml) as_papilla.push_back(id);
    }
  }

  /// The part whose tip is nearest to a place, within 8 mm; 0: there is none.
  int at(const Vector3d& x) const {
    double nearest = same_place_mm;
    int found = 0;
    for (const int id : as_papilla)
      if (const double away = (bumps[id].tip - x).norm(); away <= nearest) {
        nearest = away;
        found = id;
      }
    return found;
  }

  /// What a papilla at a place is worth beside what its skin shows.
  double evidence(const Vector3d& x) const {
    const int id = at(x);
    return id == 0 ? 0 : std::min(bumps[id].height, most_papilla);
  }
};

struct Candidate {
  SkinPoint at;
  double score = 0;
};

/// Places on the skin, the best first.
std::vector<Candidate> ranked(const std::vector<SkinPoint>& skin, const StandingOut& out,
                              const BreastRegion& region, const Vector3d& front) {
  std::vector<Candidate> all;
  for (const SkinPoint& point : skin) {
    if (!is_well_inside(region, point.x_in_lps)) continue;
    const double near = (point.x_in_lps - front).norm() / nearness_mm;
    all.push_back({point, point.sum() + out.evidence(point.x_in_lps) - 0.5 * near * near});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return all;
}

/// The best of the ranked that lie apart from each other.
std::vector<Candidate> apart(const std::vector<Candidate>& all) {
  std::vector<Candidate> best;
  for (const Candidate& c : all) {
    const bool is_new = std::all_of(best.begin(), best.end(), [&](const Candidate& other) {
      return (c.at.x_in_lps - other.at.x_in_lps).norm() > apart_mm;
    });
    if (is_new) best.push_back(c);
    if (best.size() == most_candidates) break;
  }
  return best;
}

/// Root mean square distance of the candidates from the first, by how nearly they are as good.
double deviation(const std::vector<Candidate>& best) {
  double sum = 0, weights = 0;
  for (const Candidate& c : best) {
    const double weight = std::exp(c.score - best.front().score);
    sum += weight * (c.at.x_in_lps - best.front().at.x_in_lps).squaredNorm();
    weights += weight;
  }
  return std::sqrt(sum / weights + at_best_sd_mm * at_best_sd_mm);
}

/// Mean of the places around the first, by how nearly they are as good: which single voxel is best
/// hangs on the grid.
Vector3d middle(const std::vector<Candidate>& all) {
  const Candidate& first = all.front();
  Vector3d sum = Vector3d::Zero();
  double weights = 0;
  for (const Candidate& c : all) {
    if ((c.at.x_in_lps - first.at.x_in_lps).norm() > apart_mm / 2) continue;
    const double weight = std::exp(c.score - first.score);
    sum += weight * c.at.x_in_lps;
    weights += weight;
  }
  return sum / weights;
}

/// What stands out at the nipple, if anything does; the tip moves to its middle.
void take_papilla(const StandingOut& out, Nipple& nipple) {
  const int papilla = out.at(nipple.tip_in_lps);
  if (papilla == 0) return;
  nipple.tip_in_lps = out.bumps[papilla].tip;
  nipple.papilla = out.parts.ids.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < nipple.papilla.values.size(); ++v)
    nipple.papilla.values[v] = out.parts.ids.values[v] == papilla;
}

}  // namespace

Nipple unknown_nipple(const Mask& labels, const BreastRegion& region) {
  Nipple nipple;
  nipple.tip_in_lps = nipple.rival_in_lps = most_anterior_point(labels, region);
  nipple.sd_mm = not_found_sd_mm;
  return nipple;
}

Nipple find_nipple(const Mask& labels, const BreastRegion& region, const Volume<float>& look) {
  Nipple nipple = unknown_nipple(labels, region);
  const Vector3d front = nipple.tip_in_lps;
  const Near near = cut_near(labels, look, front);
  const StandingOut out(near.body);
  const std::vector<Candidate> all =
      ranked(skin_around(near.body, near.look, front, reach_mm), out, region, front);
  const std::vector<Candidate> best = apart(all);
  if (best.empty()) return nipple;
  nipple.evidence = best.front().at.sum() + out.evidence(best.front().at.x_in_lps);
  nipple.is_found = nipple.evidence >= least_evidence;
  nipple.rival_in_lps = best[best.size() > 1 && nipple.is_found ? 1 : 0].at.x_in_lps;
  if (!nipple.is_found) return nipple;
  nipple.tip_in_lps = middle(all);
  nipple.sd_mm = deviation(best);
  take_papilla(out, nipple);
  return nipple;
}

void label_papilla(const Nipple& nipple, Segmentation& s) {
  const Mask& papilla = nipple.papilla;
  for (int k = 0; k < papilla.size.z(); ++k)
    for (int j = 0; j < papilla.size.y(); ++j)
      for (int i = 0; i < papilla.size.x(); ++i) {
        if (!papilla(i, j, k)) continue;
        const Vector3i v = s.labels.index(papilla.position(i, j, k)).array().round().cast<int>();
        std::uint8_t& value = s.labels(v.x(), v.y(), v.z());
        if (value != label::fibroglandular) continue;
        value = label::skin;
        s.fractions(v.x(), v.y(), v.z()) = pure_fractions(label::skin);
      }
}

Nipple mirrored(Nipple nipple) {
  nipple.tip_in_lps = mirrored(nipple.tip_in_lps);
  nipple.rival_in_lps = mirrored(nipple.rival_in_lps);
  if (!nipple.papilla.values.empty()) nipple.papilla = mirrored(nipple.papilla);
  return nipple;
}

}  // namespace mammotwin
