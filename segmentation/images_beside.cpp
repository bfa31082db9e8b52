#include "segmentation/images_beside.h"

#include <stdexcept>

#include "segmentation/mirrored.h"

namespace mammotwin {
namespace {

/// The series of the folder that has a part beside the one that was read; null where none has.
const SeriesRow* series_that(bool SeriesRow::*has_part, const Mri& mri) {
  for (const SeriesRow& row : mri.series)
    if (row.*has_part) return &row;
  return nullptr;
}

/// An image that is used beside the one that is read: the file or series that is named, or a series
/// that was chosen; that one is nothing, and noted, where it cannot be read.
std::optional<Mri> read_beside(const std::optional<std::filesystem::path>& file,
                               const std::optional<std::string>& series, const SeriesRow* chosen,
                               const std::filesystem::path& folder, SegmentResult& result) {
  const bool named = file || series;
  if (!named && !chosen) return std::nullopt;
  try {
    Mri mri = read_mri(file ? *file : folder, named ? series : std::optional(chosen->uid));
    result.files.insert(result.files.end(), mri.files.begin(), mri.files.end());
    if (result.quality.in_mirror) mri.image = mirrored(mri.image);
    return mri;
  } catch (const std::exception&) {
    if (named) throw;
    result.quality.notes.push_back("series " + chosen->number +
                                   " of the study cannot be read: it is not used");
    return std::nullopt;
  }
}

}  // namespace

BeforeAgent read_before_agent(const Mri& mri, const SegmentInput& input, const BodyStage& body,
                              SegmentResult& result) {
  const auto pre = read_beside(input.pre, input.pre_series,
                               series_that(&SeriesRow::is_before_agent, mri), *input.mri, result);
  if (!pre) return {};
  BeforeAgent before =
      lay_before_agent(body.lone ? with_mirror_image(pre->image, *body.lone) : pre->image, body);
  if (input.pre || input.pre_series || before.shows_uptake(body.body)) return before;
  result.quality.notes.push_back(
      "the phase before the one that was read shows no uptake of contrast agent between the two: "
      "it is not used");
  return {};
}

void use_if_still(const std::optional<PreMatch>& match, bool named, BeforeAgent& before,
                  SegmentQuality& quality) {
  if (!before.is_given()) return;
  if (!named && match && match->moved()) {
    before = {};
    quality.notes.push_back(
        "the patient moved between the phase that was read and the one before: that is not used");
    return;
  }
  quality.notes.push_back(
      "lesions were outlined in the enhancement over the image before contrast agent");
}

std::optional<OtherImage> read_other_image(const Mri& mri, const SegmentInput& input,
                                           const BodyStage& body, const PectoralWall& found,
                                           Side side, double stiffness, SegmentResult& result) {
  const SeriesRow* chosen = series_that(&SeriesRow::is_compared, mri);
  const auto other = read_beside(input.compared, input.compared_series, chosen, *input.mri, result);
  if (!other) return std::nullopt;
  const std::string called = input.compared          ? "the image that mri.compared names"
                             : input.compared_series ? "the series that mri.compared_series names"
                                                     : "series " + chosen->number + " of the study";
  try {
    return OtherImage{called, compared_wall(other->image, found, body, side, stiffness)};
  } catch (const std::exception& error) {
    result.quality.notes.push_back("the chest wall was not compared with that in " + called +
                                   ", which shows none: " + error.what());
    return std::nullopt;
  }
}

}  // namespace mammotwin
