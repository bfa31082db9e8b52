#include "segmentation/segment.h"

#include <cmath>
#include <stdexcept>

#include "segmentation/body/breast_region.h"
#include "segmentation/body/judge_region.h"
#include "segmentation/body/nipple.h"
#include "segmentation/body/tissue_columns.h"
#include "segmentation/files/markups.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/label_maps/segment_labels.h"
#include "segmentation/mirrored.h"
#include "segmentation/mri/read_mri.h"
#include "segmentation/segment_limits.h"
#include "segmentation/segment_mri.h"

namespace mammotwin {
namespace {

/// What is not breast has no fractions; skin counts as fat.
void settle_fractions(Segmentation& s) {
  for (std::size_t v = 0; v < s.labels.values.size(); ++v) {
    const std::uint8_t value = s.labels.values[v];
    Fractions& f = s.fractions.values[v];
    const float sum = f.fat + f.fibroglandular + f.lesion;
    if (!label::is_breast(value) || !(sum > 0)) f = pure_fractions(value);
  }
}

void crop(SegmentResult& result) {
  Segmentation& s = result.segmentation;
  const VoxelBox box = box_around(s.labels, 5);
  s.labels = cropped(s.labels, box.low, box.high);
  s.fractions = cropped(s.fractions, box.low, box.high);
  if (!result.image.values.empty()) result.image = cropped(result.image, box.low, box.high);
}

/// Over the breastbone's border, beside a breast whose medial edge slants.
void set_wall_back(const FoundRegion& found, Segmentation& s, SegmentQuality& quality) {
  const Volume<std::uint8_t> before = s.labels;
  set_muscle_back(s.labels, found.region, least_tissue_mm);
  for (std::size_t v = 0; v < before.values.size(); ++v)
    if (s.labels.values[v] != before.values[v])
      s.fractions.values[v] = pure_fractions(s.labels.values[v]);
  quality.notes.push_back(
      "over " + std::to_string(std::lround(found.thin_mm2 / 100)) +
      " cm2 beside the breast the chest wall lay less than 5 mm under the skin; "
      "it was set back to there, so that the region holds the breast");
}

/// What shows the nipple: the image, fat at 1, with papilla and gland brighter than fat; or gland.
Volume<float> look_of(const SegmentResult& result) {
  constexpr float gland_over_fat = 0.8F;
  const Volume<Fractions>& fractions = result.segmentation.fractions;
  Volume<float> look = fractions.like<float>(0);
  const bool has_image = !result.image.values.empty();
  const bool suppressed = result.quality.contrast == "fat-suppressed";
  for (std::size_t v = 0; v < look.values.size(); ++v) {
    const Fractions& f = fractions.values[v];
    if (!has_image)
      look.values[v] = 1 + gland_over_fat * (f.fibroglandular + f.lesion);
    else if (suppressed)
      look.values[v] = result.image.values[v];
    else
      look.values[v] = std::max(0.0F, 2 - result.image.values[v]);
  }
  return look;
}

/// Gland below the skin of a label map is no areola: without an image only a papilla tells, and
/// only where nothing else on the skin looks like one.
Nipple nipple_of(const Volume<std::uint8_t>& labels, const BreastRegion& region,
                 const Volume<float>& look, bool has_image) {
  constexpr double most_sd_mm = 10;
  const Nipple nipple = find_nipple(labels, region, look);
  const bool is_seen = has_image || (!nipple.papilla.values.empty() && nipple.sd_mm <= most_sd_mm);
  return is_seen ? nipple : unknown_nipple(labels, region);
}

/// A right breast's as that of the left one that it mirrors.
Nipple nipple_of(const SegmentResult& result) {
  const Segmentation& s = result.segmentation;
  const bool has_image = !result.image.values.empty();
  const Volume<float> look = look_of(result);
  if (s.region.side == Side::left) return nipple_of(s.labels, s.region, look, has_image);
  return mirrored(nipple_of(mirrored(s.labels), mirrored(s.region), mirrored(look), has_image));
}

void place_nipple(const SegmentInput& input, SegmentResult& result) {
  Segmentation& s = result.segmentation;
  if (input.nipple_in_lps) {
    s.nipple_in_lps = *input.nipple_in_lps;
  } else if (input.nipple_markups) {
    s.nipple_in_lps = read_markups_point(*input.nipple_markups);
  } else {
    const Nipple nipple = nipple_of(result);
    s.nipple_in_lps = nipple.tip_in_lps;
    if (!input.label_map) label_papilla(nipple, s);
    judge_nipple(nipple, result.quality);
    return;
  }
  auto breast = s.labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < breast.values.size(); ++v)
    breast.values[v] = label::is_breast(s.labels.values[v]);
  const Eigen::Vector3d& x = s.nipple_in_lps;
  const Eigen::Vector3i v = s.labels.index(x).array().round().cast<int>();
  constexpr double farthest_mm = 15;
  const double off =
      s.labels.contains(v.x(), v.y(), v.z()) ? distance_to(breast)(v.x(), v.y(), v.z()) : INFINITY;
  if (off > farthest_mm)
    throw std::runtime_error(
        "the nipple given lies more than 15 mm outside the breast; expected "
        "a point on its skin in LPS [mm] (is it in RAS, or the other side?)");
}

FoundRegion region_for(const SegmentInput& input, const Segmentation& s) {
  if (!input.region_markups) return find_region(s.labels, s.region.side, LabelsHold::one_side);
  const Eigen::AlignedBox3d box = read_markups_box(*input.region_markups);
  return given_region(s.labels,
                      {s.region.side, box.min().x(), box.max().x(), box.min().z(), box.max().z()});
}

void measure_volumes(const Segmentation& s, SegmentQuality& q) {
  const double ml = s.labels.voxel_volume() / 1000;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const std::uint8_t value = s.labels(i, j, k);
        if (!label::is_breast(value) || !s.region.contains(s.labels.position(i, j, k))) continue;
        q.breast_volume_ml += ml;
        if (value == label::skin) {
          q.skin_ml += ml;
          continue;
        }
        q.fat_ml += ml * s.fractions(i, j, k).fat;
        q.fibroglandular_ml += ml * s.fractions(i, j, k).fibroglandular;
      }
}

/// Mean thickness of the skin label in the region: twice the mean depth of its voxels below air.
double labelled_skin_thickness(const Segmentation& s) {
  auto air = s.labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < air.values.size(); ++v)
    air.values[v] = s.labels.values[v] == label::air;
  const Volume<float> depth = distance_to(air);
  const double half_voxel = std::cbrt(s.labels.voxel_volume()) / 2;
  double sum = 0, count = 0;
  for (int k = 0; k < air.size.z(); ++k)
    for (int j = 0; j < air.size.y(); ++j)
      for (int i = 0; i < air.size.x(); ++i)
        if (s.labels(i, j, k) == label::skin && s.region.contains(air.position(i, j, k)))
          sum += depth(i, j, k) - half_voxel, ++count;
  return count > 0 ? 2 * sum / count : 0;
}

void hand_on_mri(const SegmentInput& input, SegmentResult& result) {
  if (!input.mri) return;
  const Mri mri = read_mri(*input.mri, input.series);
  result.files.insert(result.files.end(), mri.files.begin(), mri.files.end());
  const Volume<std::uint8_t>& grid = result.segmentation.labels;
  result.image = grid.like<float>(0);
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i) {
        const Eigen::Vector3i v =
            mri.image.index(grid.position(i, j, k)).array().round().cast<int>();
        if (mri.image.contains(v.x(), v.y(), v.z()))
          result.image(i, j, k) = mri.image(v.x(), v.y(), v.z());
      }
}

void judge_volumes(SegmentQuality& q) {
  if (q.breast_volume_ml < limits::least_breast_ml || q.breast_volume_ml > limits::most_breast_ml)
    q.doubt(SegmentStatus::look,
            {"region", "the breast's volume is " +
                           std::to_string(static_cast<int>(q.breast_volume_ml)) +
                           " ml; expected 30 to 4000 ml (are the units mm?)"});
}

}  // namespace

SegmentResult segment(const SegmentInput& input, const SegmentOptions& options,
                      const SegmentProgress& progress) {
  const auto tell = [&](double fraction, const std::string& what) {
    if (progress) progress(fraction, what);
  };
  if (!input.label_map && !input.mri)
    throw std::invalid_argument("neither an MRI nor a label map is given; expected one of them");
  if (input.wall_markups && input.label_map)
    throw std::invalid_argument(
        "a chest wall is drawn, but a label map is taken as the segmentation; expected an MRI "
        "alone "
        "(the muscle of a label map is corrected in it)");
  SegmentResult result;
  if (input.label_map) {
    tell(0, "reading the label map");
    result = segment_labels(input);
  } else {
    result = segment_mri(input, options,
                         [&](double f, const std::string& what) { tell(0.9 * f, what); });
  }
  Segmentation& s = result.segmentation;
  SegmentQuality& q = result.quality;
  tell(0.9, "finding the breast's region");
  settle_fractions(s);
  crop(result);
  const FoundRegion found = region_for(input, s);
  s.region = found.region;
  if (found.thin_mm2 > 0) set_wall_back(found, s, q);
  if (result.judge_in_region) result.judge_in_region(s.region, q);
  place_nipple(input, result);
  judge_region(found, s, q);
  if (input.label_map) hand_on_mri(input, result);
  tell(0.95, "measuring");
  q.side = s.region.side;
  q.lesions = s.lesions;
  q.nipple_in_lps = s.nipple_in_lps;
  measure_volumes(s, q);
  if (input.label_map) q.skin_thickness_mm = labelled_skin_thickness(s);
  judge_volumes(q);
  tell(1, "done");
  return result;
}

}  // namespace mammotwin
