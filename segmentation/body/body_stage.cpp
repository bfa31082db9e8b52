#include "segmentation/body/body_stage.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "segmentation/body/body_mask.h"
#include "segmentation/body/contrast.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/denoise.h"
#include "segmentation/image/noise.h"

namespace mammotwin {
namespace {

constexpr double least_width_mm = 90, least_depth_mm = 80, least_height_mm = 60;  // of one breast
constexpr double before_apex_mm = 15, behind_sternum_mm = 115;
constexpr double cut_fat_suppressed = 0.45, cut_other = 0.30;
constexpr double ghost_share = 0.3;

std::string extent_text(const Eigen::Vector3d& extent) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(0);
  text << extent.x() << " x " << extent.y() << " x " << extent.z() << " mm";
  return text.str();
}

/// Share of the voxels on the faces of the image that are body; front, left, right, top, bottom.
double border_share(const Volume<std::uint8_t>& body) {
  double in = 0, all = 0;
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i) {
        const bool border =
            i == 0 || i == body.size.x() - 1 || j == 0 || k == 0 || k == body.size.z() - 1;
        if (border) in += body(i, j, k), ++all;
      }
  return all > 0 ? in / all : 0;
}

void check_extent(const Volume<float>& image) {
  const Eigen::Vector3d extent = image.size.cast<double>().cwiseProduct(image.spacing);
  if (extent.x() >= least_width_mm && extent.y() >= least_depth_mm && extent.z() >= least_height_mm)
    return;
  constexpr double mostly = 0.5;
  const bool full = border_share(coarse_body(image, estimate_noise(image))) > mostly;
  throw std::runtime_error(
      (full ? "the breast is cut by the field of view on every side: the image covers "
            : "there is no breast in it: the image covers ") +
      extent_text(extent) +
      "; expected a prone MRI of both breasts or one, at least 90 x 80 x 60 mm");
}

/// Cuts away the air in front and what lies far behind, where the frame says so.
BodyStage crop_to_frame(const Volume<float>& image, const Volume<std::uint8_t>& body,
                        const BreastFrame& frame) {
  const auto row = [&](double y) {
    return std::clamp(static_cast<int>(std::lround((y - image.origin.y()) / image.spacing.y())), 0,
                      image.size.y() - 1);
  };
  const Eigen::Vector3i low(0, row(frame.front_y - before_apex_mm), 0);
  const Eigen::Vector3i high(image.size.x() - 1, row(frame.sternal_y + behind_sternum_mm),
                             image.size.z() - 1);
  BodyStage stage;
  stage.image = cropped(image, low, high);
  stage.body = cropped(body, low, high);
  stage.frame = frame;
  return stage;
}

/// The frame; a body that has breasts only when seen from behind names its header's fault.
BreastFrame checked_frame(const Volume<std::uint8_t>& body) {
  std::string reason;
  try {
    return find_breast_frame(body);
  } catch (const std::runtime_error& error) {
    reason = error.what();
  }
  auto turned = body;
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i) turned(i, j, k) = body(i, body.size.y() - 1 - j, k);
  try {
    find_breast_frame(turned);
  } catch (const std::runtime_error&) {
    throw std::runtime_error(reason);
  }
  throw std::runtime_error(
      "the breasts stand out towards the patient's back: front and back are exchanged in the "
      "header; expected a prone MRI with its true orientation (export it again)");
}

/// Body columns that begin on the first row: the field of view cuts the breast's tip.
double clipped_in_front(const Volume<std::uint8_t>& body) {
  double clipped = 0;
  for (int k = 0; k < body.size.z(); ++k)
    for (int i = 0; i < body.size.x(); ++i) clipped += body(i, 0, k);
  return clipped * body.spacing.x() * body.spacing.z() / 100;  // cm^2
}

/// What is given stands. Where skin hardly differs from fat, what is not fat decides, and doubt
/// stays if the skin says otherwise.
Contrast decided_contrast(const BodyStage& stage, std::optional<bool> given,
                          SegmentQuality& quality) {
  // Thin skin reads near 1: skin of 1 mm in voxels of 1.2 mm 0.90 without suppression and 0.95
  // after contrast agent.
  constexpr double clearly_darker = 0.86, clearly_brighter = 1.05;
  // A voxel of more holds skin with air or fat; where all are as large, none shows it better.
  constexpr double usual_mm = 1.8, least_times = 1.5;
  const Eigen::Vector3d& spacing = stage.image.spacing;
  const double thick_mm = std::max(usual_mm, least_times * spacing.minCoeff());
  Contrast contrast = find_contrast(
      stage.image,
      spacing.maxCoeff() > thick_mm ? depth_where_thin(stage.depth, thick_mm) : stage.depth,
      stage.frame);
  if (given) {
    contrast.fat_suppressed = *given;
    return contrast;
  }
  if (contrast.skin_over_fat < clearly_darker || contrast.skin_over_fat > clearly_brighter)
    return contrast;
  const bool outshone = is_fat_outshone(stage.image, stage.body, stage.depth, stage.frame);
  if (outshone == contrast.fat_suppressed) return contrast;
  contrast.fat_suppressed = outshone;
  std::ostringstream reason;
  reason.precision(2);
  reason << "the skin is " << contrast.skin_over_fat
         << " times as bright as the fat under it, but most else "
         << (outshone ? "brighter" : "darker")
         << " than fat, so whether fat is suppressed is unsure; it was taken as "
         << (outshone ? "suppressed" : "not suppressed") << ": set mri.fat_suppressed";
  quality.doubt(SegmentStatus::look, {"contrast", reason.str()});
  return contrast;
}

/// Noise that a scanner's software spread over neighbours shows between every second voxel; there
/// anatomy would pass for noise in images that were not interpolated.
void measure_noise(const Volume<float>& whole, const Volume<std::uint8_t>& body, BodyStage& stage) {
  constexpr double correlated = 0.1;  // 0.01 to 0.02 of white noise, 0.3 of two real patients
  stage.noise = stage.noise_at_distance = noise_of_detail(stage.image, stage.body);
  if (noise_correlation(whole, body).value_or(0) > correlated)
    stage.noise_at_distance = std::max(stage.noise, noise_of_detail(stage.image, stage.body, 2));
}

/// Adds what noise hides of dark skin, of nipples above all, and denoising shows. In front only:
/// behind, what is dim would pass for body.
void add_dark_skin(double noise_in_air, BodyStage& stage) {
  const Volume<std::uint8_t> shown = coarse_body(stage.clean, noise_in_air);
  for (int k = 0; k < shown.size.z(); ++k)
    for (int j = 0; j < shown.size.y() && shown.position(0, j, 0).y() < stage.frame.sternal_y; ++j)
      for (int i = 0; i < shown.size.x(); ++i) stage.body(i, j, k) |= shown(i, j, k);
}

bool shows_both_breasts(const Volume<std::uint8_t>& body) {
  try {
    find_breast_frame(body);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// What compares both breasts says nothing of an image and its mirror image.
void say_lone(const LoneBreast& lone, const Volume<std::uint8_t>& body, SegmentQuality& quality) {
  const std::string name = to_string(lone.side);
  quality.notes.push_back("the image shows the " + name +
                          " breast alone: its mirror image at the breastbone stands for the other "
                          "one, with which nothing is compared");
  if (!lone.is_cut) return;
  constexpr double edge_radius_mm = 30;
  const Eigen::Vector3d middle = body.position(0, body.size.y() / 2, body.size.z() / 2);
  quality.doubt(SegmentStatus::look,
                {"region",
                 "the image ends beside the breastbone, where the skin of the " + name +
                     " breast still falls towards it: its medial part may be missing",
                 Eigen::Vector3d(lone.breastbone_x, middle.y(), middle.z()), edge_radius_mm});
}

/// `body`: the coarse one of the image, which shows both breasts.
BodyStage find_both(const Volume<float>& image, const Volume<std::uint8_t>& body,
                    double noise_in_air, std::optional<bool> fat_suppressed,
                    SegmentQuality& quality) {
  const BreastFrame frame = checked_frame(body);
  constexpr double largest_clip_cm2 = 4;  // a nipple's worth: the breast's tip is missing
  if (const double clip = clipped_in_front(body); clip > largest_clip_cm2)
    throw std::runtime_error("the breast is cut by the field of view in front over " +
                             std::to_string(static_cast<int>(clip)) +
                             " cm2; expected air in front of it");
  BodyStage stage = crop_to_frame(image, body, frame);
  measure_noise(image, body, stage);
  stage.clean = denoised(stage.image, stage.noise);
  stage.depth = depth_below_surface(stage.body);
  stage.contrast = decided_contrast(stage, fat_suppressed, quality);
  add_dark_skin(noise_in_air, stage);
  if (stage.contrast.fat_suppressed) stage.body = cut_ghosts(stage.image, stage.body, ghost_share);
  stage.body = cut_islands(stage.body);
  stage.body = cut_rim(stage.image, stage.body,
                       stage.contrast.fat_suppressed ? cut_fat_suppressed : cut_other);
  stage.frame = find_breast_frame(stage.body);
  stage.depth = depth_below_surface(stage.body);
  quality.contrast = stage.contrast.fat_suppressed ? "fat-suppressed" : "not fat-suppressed";
  quality.signal_to_noise =
      subcutaneous_fat(stage.image, stage.depth, stage.frame, stage.contrast.fat_suppressed) /
      std::max(stage.noise, 1e-6);
  return stage;
}

}  // namespace

BodyStage find_body(const Volume<float>& image, std::optional<bool> fat_suppressed,
                    SegmentQuality& quality) {
  check_extent(image);
  const double noise_in_air = estimate_noise(image);
  const Volume<std::uint8_t> body = coarse_body(image, noise_in_air);
  std::optional<LoneBreast> lone;
  if (!shows_both_breasts(body)) lone = find_lone_breast(body);
  if (!lone) return find_both(image, body, noise_in_air, fat_suppressed, quality);
  say_lone(*lone, body, quality);
  BodyStage stage = find_both(with_mirror_image(image, *lone), with_mirror_image(body, *lone),
                              noise_in_air, fat_suppressed, quality);
  stage.lone = lone;
  return stage;
}

}  // namespace mammotwin
