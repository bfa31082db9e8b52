#pragma once

#include <string>
#include <vector>

#include "registration/search/edge_prior.h"
#include "registration/search/view_match.h"

namespace mammotwin {

/// How the search against a view's mammogram ended.
enum class SearchEnd {
  none,            ///< there was none to search against
  ok,              ///< the breast lies on its mammogram
  look,            ///< it does, and a person should see how
  no_registration  ///< it does not: the prediction is the one without the mammogram
};

/// As it stands in sidecars: "none", "ok", "look", "no registration".
const char* name_of(SearchEnd end);

struct SearchVerdict {
  SearchEnd end = SearchEnd::none;
  std::vector<std::string> reasons;  ///< sentences with numbers and units
  bool in_place = false;             ///< surely (view_match.h), whatever else is strange
  /// What is strange of the state, where that alone, by kBelievedDeviations at most, is why there
  /// is no registration.
  std::vector<std::string> strange = {};
};

/// Beyond these a model lies on no mammogram, or on another breast's.
namespace no_registration {
inline constexpr double kOutline_mm = 8;  ///< RMS
/// Off the mammogram's nipple, where that is also four of its standard deviations. Of 84 searches
/// against drawn mammograms of the same breast, hung as they should, none left more than 15 mm.
inline constexpr double kNipple_mm = 20, kNippleDeviations = 4;
/// Of the pattern of dense tissue, at least: searches against mammograms that are not hers found
/// 0.55 at most, but for one of exchanged views (0.63) and MLOs of two upside down (0.59 to 0.69),
/// whose view is doubted, too; breasts in place 0.68 and more.
inline constexpr double kCorrelation = 0.6;
inline constexpr double kStateDeviations = 2;     ///< of a number's prior
inline constexpr double kBelievedDeviations = 3;  ///< beside a view that is surely in place
}  // namespace no_registration

/// Judges what a search of `view` left: differences, and the state in physical units. A state's
/// number is held against its prior: one more than two standard deviations off is `look` where the
/// view is surely in place (view_match.h), else no registration. Without a pattern to compare
/// `look` is the best end. `baseline`: what the affine baseline left; `look` where its outline lies
/// more than a millimetre nearer than the model's. A mammogram that may be of another view is
/// `look` at best, and none where a pattern that there is is not in place.
SearchVerdict judge_search(const std::string& view, const MatchFigures& left,
                           const ViewState& state, const EdgePrior& edge, bool complete,
                           const std::optional<MatchFigures>& baseline = {});

/// Views are searched together, and their mammograms are of one breast. A view that has no
/// registration for its strange state alone is `look` beside one that is surely in place, if no
/// number is more than three standard deviations off and it has a pattern. Beside one with no
/// registration `ok` becomes `look`, and `look` no registration unless it is surely in place.
/// `views` are their names.
void judge_together(const std::vector<std::string>& views, std::vector<SearchVerdict>& verdicts);

}  // namespace mammotwin
