#include "segmentation/body/breast_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "segmentation/body/apices.h"
#include "segmentation/body/fullest_box.h"
#include "segmentation/body/pendant_tissue.h"
#include "segmentation/image/components.h"

namespace mammotwin {
namespace {

constexpr double thick_share = 0.35;  // of the column through the apex
constexpr double beyond_thick_mm = 15;
/// Laterally a column runs along the flank, thick or not by where the wall bends back there; how
/// far the breast hangs is seen from any side.
constexpr double beyond_hanging_mm = 35, hanging_beyond = 0.01;
constexpr double least_apex_mm = 15;  // a breast thinner than this is none
constexpr double flank_worth = 0.1;   // of tissue behind the breastbone's skin, over that before it
constexpr double most_outside = 0.03;        // of the pendant tissue, before the region is widened
constexpr double worth_setting_back = 0.02;  // of the pendant tissue: for less no muscle is moved
constexpr double surely_breast_mm = 10;  // in front of the breastbone's skin: the breast, for sure

/// The columns of one side, from the medial end on.
ColumnBox side_columns(const Volume<std::uint8_t>& labels, const TissueColumns& columns, Side side,
                       LabelsHold hold) {
  const std::vector<double> profile = front_profile(columns.front, columns.nx, 0, columns.nz - 1);
  ColumnBox half{0, columns.nx - 1, 0, columns.nz - 1};
  while (half.i0 < half.i1 && !std::isfinite(profile[half.i0])) ++half.i0;
  while (half.i1 > half.i0 && !std::isfinite(profile[half.i1])) --half.i1;
  if (hold == LabelsHold::one_side) return half;
  if (const auto apices = find_apices(profile, labels.spacing.x()))
    (side == Side::left ? half.i0 : half.i1) = static_cast<int>(
        side == Side::left ? std::ceil(apices->valley) : std::floor(apices->valley));
  return half;
}

struct Apex {
  int i = 0, k = 0;
  double tissue = 0;
};

/// Where the skin reaches farthest forward, of the columns with tissue enough for a breast: not a
/// shoulder, and no island beside the body, which reach less far than it. Of columns that reach
/// equally far the one with most tissue.
Apex farthest_apex(const TissueColumns& columns, const ColumnBox& half) {
  Apex apex{half.i0, half.k0, 0};
  double front = -std::numeric_limits<double>::infinity();
  for (int k = half.k0; k <= half.k1; ++k)
    for (int i = half.i0; i <= half.i1; ++i)
      if (const std::size_t at = columns.at(i, k);
          columns.front[at] > front ||
          (columns.front[at] == front && columns.tissue[at] > apex.tissue))
        front = columns.front[at], apex = {i, k, columns.tissue[at]};
  return apex;
}

/// Bounding box of the connected part around the apex that is thick enough.
ColumnBox thick_box(const TissueColumns& columns, const ColumnBox& half, const Apex& apex) {
  Volume<std::uint8_t> thick({columns.nx, columns.nz, 1}, Eigen::Vector3d::Ones(),
                             Eigen::Vector3d::Zero(), 0);
  for (int k = half.k0; k <= half.k1; ++k)
    for (int i = half.i0; i <= half.i1; ++i)
      thick(i, k, 0) = columns.tissue[columns.at(i, k)] > thick_share * apex.tissue;
  const Components parts = connected_components(thick);
  ColumnBox box{apex.i, apex.i, apex.k, apex.k};
  for (int k = half.k0; k <= half.k1; ++k)
    for (int i = half.i0; i <= half.i1; ++i)
      if (parts.ids(i, k, 0) == parts.ids(apex.i, apex.k, 0)) box.hold(i, k);
  return box;
}

ColumnBox widened(ColumnBox box, const ColumnBox& half, const Volume<std::uint8_t>& labels,
                  Side side) {
  const int across = static_cast<int>(std::lround(beyond_thick_mm / labels.spacing.x()));
  const int along = static_cast<int>(std::lround(beyond_thick_mm / labels.spacing.z()));
  box.i0 = side == Side::left ? half.i0 : std::max(half.i0, box.i0 - across);
  box.i1 = side == Side::left ? std::min(half.i1, box.i1 + across) : half.i1;
  box.k0 = std::max(half.k0, box.k0 - along);
  box.k1 = std::min(half.k1, box.k1 + along);
  return box;
}

/// Row of the fold below the breast: where, from the foremost skin of a sagittal row of columns
/// down, the skin lies deepest before it comes forward again; the median over the columns of the
/// thick part. The first row of `half` where fewer than half of them show one: the region then ends
/// with the thick part. What lies below would be lifted by the plate, crumple before the wall, and
/// decide whether a compression converges.
int fold_below(const TissueColumns& columns, const ColumnBox& half, const ColumnBox& thick) {
  constexpr double comes_forward_mm = 3;
  std::vector<int> folds;
  for (int i = thick.i0; i <= thick.i1; ++i) {
    const auto front = [&](int k) { return columns.front[columns.at(i, k)]; };
    int foremost = thick.k0;
    for (int k = thick.k0; k <= thick.k1; ++k)
      if (front(k) > front(foremost)) foremost = k;
    int deepest = foremost;
    for (int k = foremost; k >= half.k0 && std::isfinite(front(k)); --k) {
      if (front(k) < front(deepest)) deepest = k;
      if (front(k) < front(deepest) + comes_forward_mm) continue;
      folds.push_back(deepest);
      break;
    }
  }
  if (2 * static_cast<int>(folds.size()) <= thick.i1 - thick.i0) return half.k0;
  const auto middle = folds.begin() + folds.size() / 2;
  std::nth_element(folds.begin(), middle, folds.end());
  return *middle;
}

/// Tissue of each column, that in front of the skin over the breastbone in full: a region gives up
/// flank and axilla before breast.
std::vector<double> worth_of(const TissueColumns& columns, double sternal_y) {
  std::vector<double> worth;
  for (std::size_t n = 0; n < columns.tissue.size(); ++n) {
    const double before = std::clamp(columns.front[n] + sternal_y, 0.0, columns.tissue[n]);
    worth.push_back(before + flank_worth * (columns.tissue[n] - before));
  }
  return worth;
}

/// All columns with tissue in front of the skin over the breastbone that a box round the apex
/// holds.
ColumnBox pendant_box(const Volume<std::uint8_t>& labels, const ColumnBox& half,
                      const PendantTissue& pendant) {
  const auto slice = [&](double z) {
    return static_cast<int>(std::lround((z - labels.origin.z()) / labels.spacing.z()));
  };
  return {half.i0, half.i1, slice(pendant.z_low), slice(pendant.z_high)};
}

/// The columns with muscle close under the skin as if it lay least_tissue_mm deep, so far medially
/// as the breast stands out in front of the breastbone's skin.
TissueColumns thickened(const TissueColumns& columns, const PendantTissue& pendant,
                        const ColumnBox& pendant_rows, const Apex& apex, Side side) {
  const int medially = side == Side::left ? -1 : 1;
  int end = apex.i;
  for (int k = pendant_rows.k0; k <= pendant_rows.k1; ++k) {
    int i = apex.i;
    const auto stands = [&](int at) {
      return at >= 0 && at < columns.nx &&
             columns.front[columns.at(at, k)] + pendant.sternal_y > surely_breast_mm;
    };
    while (stands(i + medially)) i += medially;
    end = side == Side::left ? std::min(end, i) : std::max(end, i);
  }
  TissueColumns thick = columns;
  for (int k = pendant_rows.k0; k <= pendant_rows.k1; ++k)
    for (int i = end; i != apex.i; i -= medially)
      if (const std::size_t n = columns.at(i, k); columns.on_muscle[n])
        thick.tissue[n] = std::max(thick.tissue[n], least_tissue_mm);
  return thick;
}

double thin_area(const TissueColumns& columns, const Volume<std::uint8_t>& labels,
                 const BreastRegion& region) {
  double count = 0;
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i)
      count += columns.tissue[columns.at(i, k)] < least_tissue_mm &&
               region.contains(labels.position(i, 0, k));
  return count * labels.spacing.x() * labels.spacing.z();
}

void hold_lesions(const Volume<std::uint8_t>& labels, const ColumnBox& half, ColumnBox& box) {
  for (int k = half.k0; k <= half.k1; ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = half.i0; i <= half.i1; ++i)
        if (label::is_lesion(labels(i, j, k))) box.hold(i, k);
}

/// Cut planes lie on the outer faces of the outermost columns.
BreastRegion region_of(const ColumnBox& box, const Volume<std::uint8_t>& labels, Side side) {
  const Eigen::Vector3d low = labels.position(box.i0, 0, box.k0) - labels.spacing / 2;
  const Eigen::Vector3d high = labels.position(box.i1, 0, box.k1) + labels.spacing / 2;
  return {side, low.x(), high.x(), low.z(), high.z()};
}

/// A side's breast in its columns.
struct BreastColumns {
  TissueColumns columns;
  ColumnBox half;
  Apex apex;
  PendantTissue pendant;
  Volume<std::uint8_t> hanging;
};

BreastColumns breast_columns(const Volume<std::uint8_t>& labels, Side side, LabelsHold hold) {
  BreastColumns breast;
  breast.columns = measure_columns(labels);
  breast.half = side_columns(labels, breast.columns, side, hold);
  const Apex& apex = breast.apex = farthest_apex(breast.columns, breast.half);
  if (apex.tissue < least_apex_mm)
    throw std::runtime_error(std::string("the ") + (side == Side::left ? "left" : "right") +
                             " side holds " + std::to_string(static_cast<int>(apex.tissue)) +
                             " mm of tissue at its most anterior point; expected a breast of at "
                             "least 15 mm in front of the muscle (is the side right?)");
  breast.pendant = find_pendant_tissue(labels, breast.columns, breast.half, apex.i, apex.k, side);
  breast.hanging = hanging_tissue(breast.pendant, labels);
  return breast;
}

/// The columns of its side, laterally no farther than a region may reach: 35 mm beyond where what
/// hangs ends (but for 1 % of it).
ColumnBox beside_the_breast(const BreastColumns& breast, const Volume<std::uint8_t>& labels) {
  const bool left = breast.pendant.side == Side::left;
  const double x = lateral_reach(breast.pendant, breast.hanging, hanging_beyond) +
                   (left ? beyond_hanging_mm : -beyond_hanging_mm);
  const int end = static_cast<int>(std::lround((x - labels.origin.x()) / labels.spacing.x()));
  ColumnBox half = breast.half;
  if (left)
    half.i1 = std::clamp(end, breast.apex.i, half.i1);
  else
    half.i0 = std::clamp(end, half.i0, breast.apex.i);
  return half;
}

}  // namespace

FoundRegion find_region(const Volume<std::uint8_t>& labels, Side side, LabelsHold hold) {
  const BreastColumns breast = breast_columns(labels, side, hold);
  const TissueColumns& columns = breast.columns;
  const ColumnBox half = beside_the_breast(breast, labels);
  const Apex& apex = breast.apex;
  FoundRegion found;
  found.pendant = breast.pendant;
  const std::vector<double> worth = worth_of(columns, found.pendant.sternal_y);
  const auto fullest_within = [&](const TissueColumns& of, const ColumnBox& within) {
    ColumnBox box = fullest_box(of, worth, within, apex.i, apex.k, {side});
    hold_lesions(labels, breast.half, box);
    return region_of(box, labels, side);
  };
  const auto take_if_better = [&](const BreastRegion& other, double by) {
    const OutsideRegion less = outside_region(breast.hanging, other);
    const bool better = less.share < found.outside.share - by;
    if (better) found.region = other, found.outside = less;
    return better;
  };
  const ColumnBox thick = thick_box(columns, half, apex);
  ColumnBox usual = widened(thick, half, labels, side);
  usual.k0 = std::max(usual.k0, std::min(apex.k, fold_below(columns, half, thick)));
  found.region = fullest_within(columns, usual);
  found.outside = outside_region(breast.hanging, found.region);
  if (found.outside.share <= most_outside) return found;
  ColumnBox wider = pendant_box(labels, half, found.pendant);
  ColumnBox rows = wider;  // as far laterally as usual
  wider.hold(usual.i0, usual.k0), wider.hold(usual.i1, usual.k1);
  take_if_better(fullest_within(columns, wider), 0);
  if (found.outside.share <= most_outside) return found;
  const TissueColumns with_medial = thickened(columns, found.pendant, rows, apex, side);
  (side == Side::left ? rows.i1 : rows.i0) = side == Side::left ? usual.i1 : usual.i0;
  if (take_if_better(fullest_within(with_medial, rows), worth_setting_back))
    found.thin_mm2 = thin_area(columns, labels, found.region);
  return found;
}

FoundRegion given_region(const Volume<std::uint8_t>& labels, const BreastRegion& region) {
  const Eigen::Array3i last = labels.size.array() - 1;
  const Eigen::Array3i low =
      labels.index({region.x_min, labels.origin.y(), region.z_min}).array().round().cast<int>();
  const Eigen::Array3i high =
      labels.index({region.x_max, labels.origin.y(), region.z_max}).array().round().cast<int>();
  if ((low > last).any() || (high < 0).any())
    throw std::runtime_error(
        "the breast's region given lies beside this breast; expected an ROI around it in LPS [mm] "
        "(is it the other side?)");
  const BreastColumns breast = breast_columns(labels, region.side, LabelsHold::one_side);
  const ColumnBox box{std::max(low.x(), 0), std::min(high.x(), last.x()), std::max(low.z(), 0),
                      std::min(high.z(), last.z())};
  FoundRegion found;
  found.pendant = breast.pendant;
  found.region = region_of(box, labels, region.side);
  found.outside = outside_region(breast.hanging, found.region);
  found.thin_mm2 = thin_area(breast.columns, labels, found.region);
  return found;
}

BreastRegion find_breast_region(const Volume<std::uint8_t>& labels, Side side, LabelsHold hold) {
  return find_region(labels, side, hold).region;
}

}  // namespace mammotwin
