#include "segmentation/body/breast_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "segmentation/body/apices.h"
#include "segmentation/image/components.h"

namespace mammotwin {
namespace {

constexpr double thick_share = 0.35;  // of the column through the apex
constexpr double beyond_thick_mm = 15;
constexpr double least_tissue_mm = 5;
constexpr double least_tissue_lateral_mm = 8;
constexpr double least_apex_mm = 15;  // a breast thinner than this is none

/// Tissue in front of the muscle, one value a column (i, k), i fastest.
struct Columns {
  int nx = 0, nz = 0;
  std::vector<double> tissue;  ///< [mm]
  std::vector<double> front;   ///< how far forward the skin reaches [mm], -infinity: empty

  double tissue_at(int i, int k) const { return tissue[static_cast<std::size_t>(k) * nx + i]; }
};

Columns measure_columns(const Volume<std::uint8_t>& labels) {
  auto muscle = labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    muscle.values[v] = labels.values[v] == label::muscle;
  muscle = without_small_components(muscle, least_muscle_ml);

  Columns columns;
  columns.nx = labels.size.x();
  columns.nz = labels.size.z();
  const double dy = labels.spacing.y();
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i) {
      double tissue = 0, front = -std::numeric_limits<double>::infinity();
      for (int j = 0; j < labels.size.y() && !muscle(i, j, k); ++j) {
        if (!label::is_breast(labels(i, j, k))) continue;
        if (tissue == 0) front = -labels.position(i, j, k).y();
        tissue += dy;
      }
      columns.tissue.push_back(tissue);
      columns.front.push_back(front);
    }
  return columns;
}

/// Rectangle in column indices, all ends included.
struct Rectangle {
  int i0, i1, k0, k1;
};

/// The columns of one side: from the medial end on.
Rectangle half_of_body(const Volume<std::uint8_t>& labels, const Columns& columns, Side side) {
  std::vector<double> profile(columns.nx, -std::numeric_limits<double>::infinity());
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i)
      profile[i] =
          std::max(profile[i], columns.front[static_cast<std::size_t>(k) * columns.nx + i]);
  Rectangle half{0, columns.nx - 1, 0, columns.nz - 1};
  while (half.i0 < half.i1 && !std::isfinite(profile[half.i0])) ++half.i0;
  while (half.i1 > half.i0 && !std::isfinite(profile[half.i1])) --half.i1;
  if (const auto apices = find_apices(profile, labels.spacing.x())) {
    if (side == Side::left)
      half.i0 = apices->valley;
    else
      half.i1 = apices->valley;
  }
  return half;
}

struct Apex {
  int i, k;
  double tissue;
};

Apex thickest_column(const Columns& columns, const Rectangle& half) {
  Apex apex{half.i0, half.k0, 0};
  double front = -std::numeric_limits<double>::infinity();
  for (int k = half.k0; k <= half.k1; ++k)
    for (int i = half.i0; i <= half.i1; ++i) {
      const double here = columns.front[static_cast<std::size_t>(k) * columns.nx + i];
      if (here > front) front = here, apex = {i, k, columns.tissue_at(i, k)};
    }
  return apex;
}

/// Bounding box of the connected part around the apex that is thick enough.
Rectangle thick_box(const Columns& columns, const Rectangle& half, const Apex& apex) {
  Volume<std::uint8_t> thick({columns.nx, columns.nz, 1}, Eigen::Vector3d::Ones(),
                             Eigen::Vector3d::Zero(), 0);
  for (int k = half.k0; k <= half.k1; ++k)
    for (int i = half.i0; i <= half.i1; ++i)
      thick(i, k, 0) = columns.tissue_at(i, k) > thick_share * apex.tissue;
  const Components parts = connected_components(thick);
  Rectangle box{apex.i, apex.i, apex.k, apex.k};
  for (int k = half.k0; k <= half.k1; ++k)
    for (int i = half.i0; i <= half.i1; ++i) {
      if (parts.ids(i, k, 0) != parts.ids(apex.i, apex.k, 0)) continue;
      box = {std::min(box.i0, i), std::max(box.i1, i), std::min(box.k0, k), std::max(box.k1, k)};
    }
  return box;
}

/// Pulls the edges in until no column of the rectangle has too little tissue: always the edge of
/// whose columns most are poor, times `across` for the medial and lateral ones.
class PullIn {
 public:
  PullIn(const Columns& columns, Side side, const Apex& apex, double across)
      : columns_(columns), side_(side), apex_(apex), across_(across) {}

  Rectangle operator()(Rectangle box) const {
    while (pull_worst_edge(box)) {
    }
    while (pull_past_inner_hole(box)) {
      while (pull_worst_edge(box)) {
      }
    }
    return box;
  }

 private:
  enum Edge { low_x, high_x, low_z, high_z };

  bool poor(const Rectangle& box, int i, int k) const {
    const bool lateral = i == (side_ == Side::left ? box.i1 : box.i0);
    return columns_.tissue_at(i, k) < (lateral ? least_tissue_lateral_mm : least_tissue_mm);
  }

  double poor_share(const Rectangle& box, Edge edge) const {
    int count = 0, total = 0;
    const bool along_z = edge == low_x || edge == high_x;
    for (int n = along_z ? box.k0 : box.i0; n <= (along_z ? box.k1 : box.i1); ++n, ++total) {
      const int i = along_z ? (edge == low_x ? box.i0 : box.i1) : n;
      const int k = along_z ? n : (edge == low_z ? box.k0 : box.k1);
      count += poor(box, i, k);
    }
    return static_cast<double>(count) / total * (along_z ? across_ : 1);
  }

  bool may_pull(const Rectangle& box, Edge edge) const {
    switch (edge) {
      case low_x:
        return box.i0 < apex_.i;
      case high_x:
        return box.i1 > apex_.i;
      case low_z:
        return box.k0 < apex_.k;
      default:
        return box.k1 > apex_.k;
    }
  }

  static void pull(Rectangle& box, Edge edge) {
    if (edge == low_x) ++box.i0;
    if (edge == high_x) --box.i1;
    if (edge == low_z) ++box.k0;
    if (edge == high_z) --box.k1;
  }

  bool pull_worst_edge(Rectangle& box) const {
    double worst = 0;
    Edge edge = low_x;
    for (const Edge e : {low_x, high_x, low_z, high_z}) {
      const double share = may_pull(box, e) ? poor_share(box, e) : 0;
      if (share > worst) worst = share, edge = e;
    }
    if (worst > 0) pull(box, edge);
    return worst > 0;
  }

  /// A poor column away from the edges: the edge that loses least is pulled past it.
  bool pull_past_inner_hole(Rectangle& box) const {
    for (int k = box.k0; k <= box.k1; ++k)
      for (int i = box.i0; i <= box.i1; ++i) {
        if (!poor(box, i, k)) continue;
        const std::array<int, 4> loss{
            i < apex_.i ? i - box.i0 + 1 : columns_.nx, i > apex_.i ? box.i1 - i + 1 : columns_.nx,
            k < apex_.k ? k - box.k0 + 1 : columns_.nz, k > apex_.k ? box.k1 - k + 1 : columns_.nz};
        const int edge =
            static_cast<int>(std::min_element(loss.begin(), loss.end()) - loss.begin());
        if (i == apex_.i && k == apex_.k) return false;
        for (int n = 0; n < loss[edge]; ++n) pull(box, static_cast<Edge>(edge));
        return true;
      }
    return false;
  }

  const Columns& columns_;
  Side side_;
  Apex apex_;
  double across_;
};

double tissue_in(const Columns& columns, const Rectangle& box) {
  double sum = 0;
  for (int k = box.k0; k <= box.k1; ++k)
    for (int i = box.i0; i <= box.i1; ++i) sum += columns.tissue_at(i, k);
  return sum;
}

/// The edges pulled in without preference, or, where that takes away much of a breast for a poor
/// corner, with preference for the edges that spare it.
Rectangle pulled_in(const Rectangle& box, const Columns& columns, Side side, const Apex& apex) {
  constexpr double clearly_more = 1.02;
  Rectangle best = PullIn(columns, side, apex, 1)(box);
  for (const double across : {0.5, 2.0}) {
    const Rectangle other = PullIn(columns, side, apex, across)(box);
    if (tissue_in(columns, other) > clearly_more * tissue_in(columns, best)) best = other;
  }
  return best;
}

void hold_lesions(const Volume<std::uint8_t>& labels, const Rectangle& half, Rectangle& box) {
  for (int k = half.k0; k <= half.k1; ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = half.i0; i <= half.i1; ++i) {
        if (!label::is_lesion(labels(i, j, k))) continue;
        box = {std::min(box.i0, i), std::max(box.i1, i), std::min(box.k0, k), std::max(box.k1, k)};
      }
}

Rectangle widened(Rectangle box, const Rectangle& half, const Volume<std::uint8_t>& labels,
                  Side side) {
  const int across = static_cast<int>(std::lround(beyond_thick_mm / labels.spacing.x()));
  const int along = static_cast<int>(std::lround(beyond_thick_mm / labels.spacing.z()));
  box.i0 = side == Side::left ? half.i0 : std::max(half.i0, box.i0 - across);
  box.i1 = side == Side::left ? std::min(half.i1, box.i1 + across) : half.i1;
  box.k0 = std::max(half.k0, box.k0 - along);
  box.k1 = std::min(half.k1, box.k1 + along);
  return box;
}

}  // namespace

BreastRegion find_breast_region(const Volume<std::uint8_t>& labels, Side side) {
  const Columns columns = measure_columns(labels);
  const Rectangle half = half_of_body(labels, columns, side);
  const Apex apex = thickest_column(columns, half);
  if (apex.tissue < least_apex_mm)
    throw std::runtime_error(std::string("the ") + (side == Side::left ? "left" : "right") +
                             " side holds " + std::to_string(static_cast<int>(apex.tissue)) +
                             " mm of tissue at its most anterior point; expected a breast of at "
                             "least 15 mm in front of the muscle (is the side right?)");
  Rectangle box = widened(thick_box(columns, half, apex), half, labels, side);
  box = pulled_in(box, columns, side, apex);
  hold_lesions(labels, half, box);

  // Cut planes lie on the outer faces of the outermost columns.
  const Eigen::Vector3d low = labels.position(box.i0, 0, box.k0) - labels.spacing / 2;
  const Eigen::Vector3d high = labels.position(box.i1, 0, box.k1) + labels.spacing / 2;
  return {side, low.x(), high.x(), low.z(), high.z()};
}

}  // namespace mammotwin
