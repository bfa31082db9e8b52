#include "registration/mammogram/slice_places.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace mammotwin {
namespace {

constexpr const char* kSlicePosition = "(0020,0032) ImagePositionPatient";
constexpr const char* kBetweenSlices = "(0018,0088) SpacingBetweenSlices";
constexpr const char* kSliceThickness = "(0018,0050) SliceThickness";
constexpr double kLeastSliceSpacing_mm = 0.3,
                 kMostSliceSpacing_mm = 15;  // slabs of up to 10 mm are usual

std::string shown_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string detector_key(const std::string& view, const char* name) {
  return "views." + view + ".detector." + name;
}

/// From the first slice to the last; empty where they are not told apart.
std::optional<Eigen::Vector3d> way_through(const MammogramHeader& h) {
  const SliceTags& tags = *h.slices;
  if (!tags.first_in_lps || !tags.last_in_lps || h.frames.value_or(0) < 2) return std::nullopt;
  const Eigen::Vector3d way = *tags.last_in_lps - *tags.first_in_lps;
  if (way.norm() < kLeastSliceSpacing_mm) return std::nullopt;
  return way;
}

double slice_spacing_of(const MammogramHeader& h, const std::string& view,
                        std::vector<std::string>& remarks) {
  std::string tag;
  double spacing = 0;
  if (const auto way = way_through(h)) {
    tag = kSlicePosition;
    spacing = way->norm() / (*h.frames - 1);
  } else if (h.slices->spacing_mm) {
    tag = kBetweenSlices;
    spacing = *h.slices->spacing_mm;
  } else if (h.slices->thickness_mm) {
    tag = kSliceThickness;
    spacing = *h.slices->thickness_mm;
    remarks.push_back(tag + " is taken for the distance between slices; " + kSlicePosition +
                      " and " + kBetweenSlices + " are missing");
  } else {
    throw std::runtime_error(std::string(kSlicePosition) + ", " + kBetweenSlices + " and " +
                             kSliceThickness +
                             " are missing, so nothing says how far slices lie apart; " +
                             detector_key(view, "slice_spacing_mm") + " says it");
  }
  if (spacing >= kLeastSliceSpacing_mm && spacing <= kMostSliceSpacing_mm) return spacing;
  throw std::runtime_error(tag + " makes slices " + shown_number(spacing) +
                           " mm apart; expected 0.3 to 15 mm; " +
                           detector_key(view, "slice_spacing_mm") + " overrides it");
}

bool first_at_support(const MammogramHeader& h, const Eigen::Vector3d& up,
                      const std::string& view) {
  constexpr double kAlong = 0.8;  // cosine: positioners' angles are rounded, patients lean
  const auto way = way_through(h);
  const double along = way ? way->normalized().dot(up) : 0;
  if (std::abs(along) >= kAlong) return along > 0;
  throw std::runtime_error(std::string(kSlicePosition) +
                           (way ? " does not go along the beam"
                                : " is missing or the same for all "
                                  "slices") +
                           ", so it does not say which slice lies at the support; " +
                           detector_key(view, "first_slice") +
                           " = \"support\" or \"paddle\" says it");
}

}  // namespace

TomosynthesisSlices tomosynthesis_slices(const MammogramHeader& h, const Eigen::Vector3d& up_in_lps,
                                         const std::optional<double>& thickness_mm,
                                         const SliceOverrides& o, const std::string& view,
                                         std::vector<std::string>& remarks) {
  TomosynthesisSlices stack;
  stack.count = h.frames.value_or(1);
  stack.spacing_mm = o.spacing_mm ? *o.spacing_mm : slice_spacing_of(h, view, remarks);
  stack.first_at_support =
      o.first_at_support ? *o.first_at_support : first_at_support(h, up_in_lps, view);
  stack.lowest_mm = o.lowest_mm.value_or(stack.spacing_mm / 2);
  const double high = stack.count * stack.spacing_mm;
  if (!o.lowest_mm)
    remarks.push_back("no tag says how high the lowest slice lies; taken as " +
                      shown_number(stack.lowest_mm) + " mm above the support; " +
                      detector_key(view, "lowest_slice_mm") + " says it");
  constexpr double kMostMissing_mm = 3;
  if (thickness_mm && high < *thickness_mm - kMostMissing_mm)
    remarks.push_back(std::to_string(stack.count) + " slices of " + shown_number(stack.spacing_mm) +
                      " mm are " + shown_number(high) + " mm high; the breast is " +
                      shown_number(*thickness_mm) + " mm thick: part of it is not in the volume");
  return stack;
}

}  // namespace mammotwin
