#include "segmentation/segment_mri.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "segmentation/body/midline.h"
#include "segmentation/chest_wall/half_breast.h"
#include "segmentation/chest_wall/judge_wall.h"
#include "segmentation/chest_wall/muscle_slips.h"
#include "segmentation/contrast_agent/enhancement.h"
#include "segmentation/files/markups.h"
#include "segmentation/image/crop.h"
#include "segmentation/images_beside.h"
#include "segmentation/lesion/lesion_seed.h"
#include "segmentation/lesion/lesion_stage.h"
#include "segmentation/lesion/measure_lesions.h"
#include "segmentation/mirrored.h"
#include "segmentation/mri/read_mri.h"
#include "segmentation/segment_limits.h"
#include "segmentation/shading/correct_shading.h"
#include "segmentation/shading/half_images.h"
#include "segmentation/skin/judge_skin.h"
#include "segmentation/skin/skin_stage.h"
#include "segmentation/tissue/failed_suppression.h"
#include "segmentation/tissue/tissue_stage.h"
#include "segmentation/tissue/vessels.h"

namespace mammotwin {
namespace {

Side choose_side(const SegmentInput& input, const std::vector<PlacedSeed>& seeds,
                 const BodyStage& body) {
  if (body.lone) {
    if (!input.side || *input.side == body.lone->side) return body.lone->side;
    throw std::runtime_error(std::string("the image shows the ") + to_string(body.lone->side) +
                             " breast alone; expected the " + to_string(*input.side) +
                             " one, as side says (are left and right exchanged?)");
  }
  if (input.side) return *input.side;
  const double midline = body.frame.midline_x;
  std::size_t left = 0;
  for (const PlacedSeed& seed : seeds) left += seed.point_in_lps.x() > midline;
  if (!seeds.empty() && (left == 0 || left == seeds.size())) return left ? Side::left : Side::right;
  throw std::runtime_error("the side is not clear: " + std::to_string(left) +
                           " lesion(s) on the left and " + std::to_string(seeds.size() - left) +
                           " on the right; set side = \"left\" or \"right\" in patient.toml");
}

/// The breasts were found hanging forwards: a header that says otherwise is doubted.
void judge_position(const std::string& position, SegmentQuality& quality) {
  quality.patient_position = position;
  if (!position.empty() && position.back() != 'P')
    quality.doubt(
        SegmentStatus::look,
        {"position", "the header says that the patient lay " + position +
                         ", not prone (HFP, FFP); the image must show breasts that hang forwards"});
}

/// Height over the skin between the breasts in the first and last slice, over the apex's.
void judge_end_slices(const BodyStage& body, Side side, SegmentQuality& quality) {
  constexpr double most_share = 0.5, end_slice_radius_mm = 30;
  const double apex = body.frame.sternal_y - body.frame.apex(side).y();
  double share = 0;
  Eigen::Vector3d place = body.frame.apex(side);
  for (const int k : {0, body.body.size.z() - 1})
    for (int i = 0; i < body.body.size.x(); ++i) {
      if (!is_on_side(body.body.position(i, 0, 0).x(), body.frame.midline_x, side)) continue;
      int j = 0;
      while (j < body.body.size.y() && !body.body(i, j, k)) ++j;
      if (j == body.body.size.y()) continue;
      const Eigen::Vector3d skin = body.body.position(i, j, k);
      if (const double here = (body.frame.sternal_y - skin.y()) / apex; here > share)
        share = here, place = skin;
    }
  quality.clipped_share = share;
  if (share > most_share)
    quality.doubt(SegmentStatus::look,
                  {"region",
                   "the breast may be cut by the first or last slice: it stands out there by " +
                       std::to_string(std::lround(100 * share)) + " % of its height",
                   place, end_slice_radius_mm});
}

void judge_noise(SegmentQuality& quality) {
  if (*quality.signal_to_noise < limits::signal_to_noise)
    quality.doubt(SegmentStatus::look,
                  {"noise", "the image is noisy: fat is only " +
                                std::to_string(std::lround(*quality.signal_to_noise)) +
                                " times as bright as the noise; expected at least 8"});
}

/// Tissue in front of the wall and of the skin between the breasts, smaller over larger side.
void judge_symmetry(const BodyStage& body, const PectoralWall& wall, SegmentQuality& quality) {
  double left = 0, right = 0;
  for (int k = 0; k < body.body.size.z(); ++k)
    for (int j = 0; j < body.body.size.y(); ++j)
      for (int i = 0; i < body.body.size.x(); ++i) {
        if (!body.body(i, j, k)) continue;
        const Eigen::Vector3d x = body.body.position(i, j, k);
        if (x.y() > body.frame.sternal_y || wall.is_behind(x)) continue;
        (x.x() > body.frame.midline_x ? left : right) += 1;
      }
  quality.volume_ratio = std::min(left, right) / std::max({left, right, 1.0});
  if (*quality.volume_ratio < limits::volume_ratio)
    quality.doubt(SegmentStatus::look,
                  {"region", "the two breasts differ in volume by more than 2.5 times"});
}

/// Why no voxel is a lesion's: what lies where it was said to be.
std::string why_absent(const Volume<std::uint8_t>& labels, const PlacedSeed& seed) {
  const Eigen::Vector3i v = labels.index(seed.point_in_lps).array().round().cast<int>();
  const std::uint8_t here =
      labels.contains(v.x(), v.y(), v.z()) ? labels(v.x(), v.y(), v.z()) : label::air;
  if (label::is_lesion(here))
    return "lesion " + seed.id +
           " is covered by another one; expected lesions apart from each other, in patient LPS and "
           "mm (is their place in cm?)";
  char place[80];
  std::snprintf(place, sizeof place, "[%.1f, %.1f, %.1f]", seed.point_in_lps.x(),
                seed.point_in_lps.y(), seed.point_in_lps.z());
  return "lesion " + seed.id + " at " + place + " lies in " +
         (here == label::muscle ? "muscle"
          : here == label::air  ? "air"
                                : "skin or beside it") +
         ", not in the breast; expected patient LPS in mm (is it in cm, or RAS?)";
}

std::vector<Lesion> named_lesions(const Volume<std::uint8_t>& labels,
                                  const std::vector<PlacedSeed>& seeds) {
  std::vector<Lesion> lesions;
  for (std::size_t n = 0; n < seeds.size(); ++n) {
    auto only = labels;
    for (std::uint8_t& value : only.values)
      value = value == label::lesion + n ? label::lesion : label::air;
    const std::vector<Lesion> found = measure_lesions(only);
    if (found.empty()) throw std::runtime_error(why_absent(labels, seeds[n]));
    lesions.push_back(found.front());
    lesions.back().id = seeds[n].id;
  }
  return lesions;
}

void judge_movement(const std::optional<PreMatch>& match, SegmentQuality& quality) {
  if (!match) return;
  quality.pre_shift_mm = match->shift_mm;
  if (!match->moved()) return;
  std::ostringstream reason;
  reason.setf(std::ios::fixed);
  reason.precision(1);
  reason << "the image before contrast agent lies " << *match->shift_mm
         << " mm off the one after it; expected " << limits::pre_shift_mm
         << " mm at most (did the patient move?): lesions outlined in their difference may be "
            "wrong";
  quality.doubt(SegmentStatus::look, {"movement", reason.str()});
}

/// Offers what takes up contrast agent in the breast, away from skin and wall.
void offer_candidates(const HalfBreast& half, const Volume<float>& enhancement,
                      SegmentQuality& quality) {
  constexpr double below_skin_mm = 5, above_wall_mm = 3;
  if (enhancement.values.empty()) return;
  auto allowed = half.inside;
  for (std::size_t v = 0; v < allowed.values.size(); ++v)
    allowed.values[v] &=
        half.depth.values[v] > below_skin_mm && half.above_wall.values[v] > above_wall_mm;
  quality.candidates = find_candidates(enhancement, allowed);
}

void take_as_fat(const Volume<std::uint8_t>& where, TissueSplit& split) {
  for (std::size_t v = 0; v < where.values.size(); ++v)
    if (where.values[v]) split.gland_fraction.values[v] = 0;
}

/// The vessels, where image or enhancement tell them from gland.
std::optional<Volume<std::uint8_t>> take_out_vessels(bool fat_suppressed,
                                                     const Volume<float>& enhancement,
                                                     const std::optional<PreMatch>& match,
                                                     const Volume<std::uint8_t>& interior,
                                                     TissueSplit& split) {
  const bool uptake_known = !enhancement.values.empty() && !(match && match->moved());
  if (!fat_suppressed && !uptake_known) return std::nullopt;
  Volume<std::uint8_t> vessels =
      find_vessels(split, interior, uptake_known ? enhancement : Volume<float>());
  take_as_surroundings(vessels, interior, split);
  return vessels;
}

/// What a left breast is segmented from. A right one is seen in a mirror, as the left one that it
/// is there: the same breast gets the same labels on either side.
struct LeftBreast {
  BodyStage body;
  std::vector<PlacedSeed> seeds;
  std::vector<Eigen::Vector3d> drawn;  ///< of the chest wall
};

LeftBreast in_mirror(const LeftBreast& right, const Mri& mri, const SegmentInput& input) {
  SegmentQuality said;  // of the image itself, already
  LeftBreast left{find_body(mirrored(mri.image), input.fat_suppressed, said), {}, {}};
  for (const PlacedSeed& seed : right.seeds) left.seeds.push_back(mirrored(seed));
  for (const Eigen::Vector3d& x : right.drawn) left.drawn.push_back(mirrored(x));
  return left;
}

/// Labels, fractions and image of a left breast, without its lesions' names.
void segment_left(const Mri& mri, const LeftBreast& breast, const SegmentInput& input,
                  const SegmentOptions& options, const SegmentProgress& progress,
                  SegmentResult& result) {
  constexpr Side side = Side::left;
  const BodyStage& body = breast.body;
  const std::vector<PlacedSeed>& seeds = breast.seeds;
  const std::vector<Eigen::Vector3d>& drawn = breast.drawn;
  BeforeAgent before = read_before_agent(mri, input, body, result);
  progress(0.35, "finding the chest wall");
  const WallStage wall = find_wall(body, before, side, options.wall_stiffness, drawn);
  if (!drawn.empty())
    result.quality.notes.push_back("the chest wall was drawn by hand, with " +
                                   std::to_string(drawn.size()) +
                                   " points; between them it is not doubted");
  std::optional<OtherImage> other;  // a wall that a person drew is not in question
  if (drawn.empty())
    other =
        read_other_image(mri, input, body, wall.found.wall, side, options.wall_stiffness, result);
  const bool pre_is_named = input.pre || input.pre_series;
  use_if_still(wall.pre_match, pre_is_named, before, result.quality);
  if (before.is_given()) judge_movement(wall.pre_match, result.quality);
  judge_end_slices(body, side, result.quality);
  judge_noise(result.quality);
  if (!body.lone) judge_symmetry(body, wall.found.wall, result.quality);

  progress(0.60, "correcting the coil's shading");
  const VoxelBox box = side_box(body.image, body.frame, side);
  const HalfImages coarse = cut_images(body, before, wall, box);
  const SkinStage skin = find_skin(coarse.noisy, cropped(body.body, box), body.frame);
  const HalfBreast half = half_breast(skin.surface.body, wall.found.wall, side);
  check_seeds(half, seeds, result.quality.in_mirror);
  offer_candidates(half, coarse.enhancement, result.quality);
  const HalfImages images = correct_shading(coarse, half, body.frame);
  progress(0.80, "finding the lesions");
  const bool fat_suppressed = body.contrast.fat_suppressed;
  const Volume<std::uint8_t> lesions =
      find_lesions(half, images, seeds, fat_suppressed, options, result.quality);
  judge_lesions_on_wall(half, lesions, result.quality);
  progress(0.88, "telling skin, fat and fibroglandular tissue apart");
  const double skin_mm = judge_skin(skin.slab, options, result.quality);
  const TissueMasks masks = tissue_masks(half, images.enhancement, lesions, skin_mm);
  const TissueImage tissue = tissue_image(images, wall.pre_match, body.noise_spread());
  const Volume<float> restored = restored_within(masks.interior, images.denoised, tissue);
  TissueSplit split = split_tissue(restored, masks.interior, masks.statistics, fat_suppressed);
  std::vector<MuscleSlip> slips;  // a wall that a person drew is not in question
  if (drawn.empty()) slips = find_muscle_slips(half, split.gland_fraction, images.denoised);
  if (fat_suppressed) {
    const Volume<std::uint8_t> failed = failed_suppression(
        widely_corrected(cropped(body.image, box), wall.wide_log_bias, pure_interior(half)),
        masks.statistics, masks.interior, half.depth, split.gland);
    judge_suppression(failed, body.frame.sternal_y, result.quality);
    take_as_fat(failed, split);
  }
  const std::optional<Volume<std::uint8_t>> vessels =
      take_out_vessels(fat_suppressed, images.enhancement, wall.pre_match, masks.interior, split);
  result.judge_in_region = [found = wall.found, frame = body.frame, other, slips, vessels,
                            reflected = result.quality.in_mirror](const BreastRegion& imaged,
                                                                  SegmentQuality& quality) {
    const BreastRegion region = reflected ? mirrored(imaged) : imaged;
    quality.in_mirror = reflected;
    judge_wall(found, frame, region, quality);
    if (other) judge_compared_wall(found.wall, other->wall, frame, region, other->called, quality);
    judge_muscle_slips(slips, region, quality);
    if (vessels) quality.vessels_ml = volume_in(region, *vessels);
    quality.in_mirror = false;
  };
  result.segmentation = labelled(half, skin.surface.depth, skin_mm, lesions, split);
  result.image = corrected_like(split, restored, images.denoised);
}

/// A left breast's result, seen in a mirror, as it was imaged.
void turn_back(SegmentResult& result) {
  result.segmentation = mirrored(result.segmentation);
  result.image = mirrored(result.image);
  for (LesionCandidate& found : result.quality.candidates)
    found.centroid_in_lps = mirrored(found.centroid_in_lps);
  result.quality.in_mirror = false;
}

SegmentResult segment_image(const Mri& mri, const SegmentInput& input,
                            const SegmentOptions& options, const SegmentProgress& progress) {
  LeftBreast breast;
  for (const LesionSeed& seed : input.lesions) breast.seeds.push_back(place_seed(seed));
  SegmentResult result;
  result.files = mri.files;
  result.quality.notes = mri.notes;
  result.quality.series = mri.series;
  judge_position(mri.patient_position, result.quality);

  progress(0.10, "finding the outline");
  breast.body = find_body(mri.image, input.fat_suppressed, result.quality);
  if (!mri.geometry_known)
    throw std::runtime_error(
        "its header does not say where its frames stand; expected positions "
        "and pixel spacing (export it as single slices)");
  const Side side = choose_side(input, breast.seeds, breast.body);
  if (input.wall_markups) breast.drawn = read_markups_points(*input.wall_markups);
  result.quality.in_mirror = side == Side::right;
  if (side == Side::left) {
    segment_left(mri, breast, input, options, progress, result);
  } else {
    segment_left(mri, in_mirror(breast, mri, input), input, options, progress, result);
    turn_back(result);
  }
  result.segmentation.lesions = named_lesions(result.segmentation.labels, breast.seeds);
  return result;
}

}  // namespace

SegmentResult segment_mri(const SegmentInput& input, const SegmentOptions& options,
                          const SegmentProgress& progress) {
  progress(0, "reading the MRI");
  const Mri mri = read_mri(*input.mri, input.series);
  try {
    return segment_image(mri, input, options, progress);
  } catch (const std::exception& error) {
    throw std::runtime_error(input.mri->string() + ": " + error.what());
  }
}

}  // namespace mammotwin
