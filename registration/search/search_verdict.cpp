#include "registration/search/search_verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mammotwin {
namespace {

// What is worth a look.
constexpr double kPoorOutline_mm = 5, kPoorNipple_mm = 10;
constexpr double kNearer_mm = 1;  // that a baseline explains an outline better

/// What a number of the state is called, and in what it is counted; of logarithms, the factor.
struct Words {
  const char *what, *unit;
};
constexpr std::array<Words, kStates> kWords = {{{"thickness", "mm"},
                                                {"roll", "degrees"},
                                                {"lift of the plates", "mm"},
                                                {"clearance of the plates from the wall", "mm"},
                                                {"tilt of the paddle", "degrees"},
                                                {"stiffness of gland over fat", ""},
                                                {"stiffness of the chest wall's springs", ""},
                                                {"friction with the plates", ""},
                                                {"roundness free of the coil", ""},
                                                {"turn on the detector", "degrees"},
                                                {"place in depth", "mm"},
                                                {"place sideways", "mm"}}};

template <class... Numbers>
std::string text_of(const char* format, Numbers... numbers) {
  char text[240];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

std::string outline_sentence(double rms_mm) {
  return text_of(
      "after the search the model's outline still lies %.1f mm (RMS) off the mammogram's", rms_mm);
}

std::string nipple_sentence(double mm) {
  return text_of("after the search the model's nipple still lies %.1f mm off the mammogram's", mm);
}

std::string state_sentence(int number, double value, double limit) {
  const Words& words = kWords[number];
  if (number == kFriction || number == kCoilRoundness)
    return text_of("the mammogram asks for another %s, by %.2f; beyond %.2f is unusual", words.what,
                   value, limit);
  if (shared_by_views(number))
    return text_of("the mammogram asks for %.2f times the %s; beyond %.2f is unusual",
                   std::exp(value), words.what, std::exp(limit));
  return text_of("the mammogram asks for another %s, by %.1f %s; beyond %.1f is unusual",
                 words.what, value, words.unit, limit);
}

/// Of numbers that nobody expects, `off` so many standard deviations.
std::vector<std::string> strange_state(const ViewState& off, const EdgePrior& edge) {
  std::vector<std::string> why;
  constexpr double kMost = no_registration::kStateDeviations;
  for (int i = 0; i < kStates; ++i)
    if (std::abs(off[i]) > kMost)
      why.push_back(
          state_sentence(i, off[i] * edge.sd[i], std::copysign(kMost * edge.sd[i], off[i])));
  return why;
}

/// Whatever the state.
std::vector<std::string> why_none(const MatchFigures& left) {
  std::vector<std::string> why;
  if (left.outline_rms_mm > no_registration::kOutline_mm)
    why.push_back(outline_sentence(left.outline_rms_mm) +
                  text_of(", more than %.0f mm", no_registration::kOutline_mm));
  if (left.nipple_mm &&
      *left.nipple_mm > std::max(no_registration::kNipple_mm,
                                 no_registration::kNippleDeviations * left.nipple_sd_mm))
    why.push_back(nipple_sentence(*left.nipple_mm) +
                  text_of(", more than %.0f mm", no_registration::kNipple_mm));
  if (left.pattern_correlation && *left.pattern_correlation < no_registration::kCorrelation)
    why.push_back(text_of("the patterns of dense tissue correlate by %.2f only, less than %.1f",
                          *left.pattern_correlation, no_registration::kCorrelation));
  else if (left.pattern_correlation && *left.pattern_correlation < kCorrelationInPlace &&
           !left.view_doubt.empty())
    why.push_back(left.view_doubt +
                  text_of(" and the patterns of dense tissue correlate by %.2f only",
                          *left.pattern_correlation));
  return why;
}

std::vector<std::string> why_look(const MatchFigures& left, const ViewState& off,
                                  const EdgePrior& edge, bool complete,
                                  const std::optional<MatchFigures>& baseline) {
  std::vector<std::string> why = strange_state(off, edge);
  if (baseline && baseline->outline_rms_mm + kNearer_mm < left.outline_rms_mm)
    why.push_back(
        text_of("a breast without mechanics (the baseline) lies %.1f mm (RMS) off the mammogram's "
                "outline, nearer than the model's %.1f mm",
                baseline->outline_rms_mm, left.outline_rms_mm));
  if (left.outline_rms_mm > kPoorOutline_mm) why.push_back(outline_sentence(left.outline_rms_mm));
  if (left.nipple_mm && *left.nipple_mm > std::max(kPoorNipple_mm, 2 * left.nipple_sd_mm))
    why.push_back(nipple_sentence(*left.nipple_mm));
  if (left.pattern_correlation && *left.pattern_correlation < kCorrelationInPlace)
    why.push_back(
        text_of("the patterns of dense tissue correlate by %.2f only", *left.pattern_correlation));
  if (!left.pattern_correlation)
    why.push_back(
        text_of("registered by outline and nipple alone, for the MRI has next to no gland there "
                "whose pattern could be compared (its thickness varies by %.1f mm); nothing else "
                "says that this is her breast",
                left.dense_detail_mm.value_or(0)));
  if (!left.view_doubt.empty()) why.push_back(left.view_doubt);
  if (!complete)
    why.push_back(
        "the search stopped where no equilibrium was found, with the best state that it "
        "had solved");
  return why;
}

std::string what_is_shown(const std::string& view) {
  return view +
         ": what is shown is the prediction without the mammogram, with its wide ellipse; is it "
         "this breast, this view, and its header right?";
}

}  // namespace

const char* name_of(SearchEnd end) {
  switch (end) {
    case SearchEnd::none:
      return "none";
    case SearchEnd::ok:
      return "ok";
    case SearchEnd::look:
      return "look";
    case SearchEnd::no_registration:
      break;
  }
  return "no registration";
}

SearchVerdict judge_search(const std::string& view, const MatchFigures& left,
                           const ViewState& state, const EdgePrior& edge, bool complete,
                           const std::optional<MatchFigures>& baseline) {
  SearchVerdict verdict{SearchEnd::no_registration, {}, surely_in_place(left)};
  const ViewState off = edge.deviations(state);
  std::string prefix = view + ": no registration: ";
  std::vector<std::string> why = why_none(left);
  if (!verdict.in_place) {
    const std::vector<std::string> strange = strange_state(off, edge);
    const bool believable = left.pattern_correlation &&
                            off.cwiseAbs().maxCoeff() <= no_registration::kBelievedDeviations;
    if (why.empty() && believable) verdict.strange = strange;
    why.insert(why.end(), strange.begin(), strange.end());
  }
  if (why.empty()) {
    why = why_look(left, off, edge, complete, baseline);
    verdict.end = why.empty() ? SearchEnd::ok : SearchEnd::look;
    prefix = view + ": ";
  }
  for (const std::string& reason : why) verdict.reasons.push_back(prefix + reason);
  if (verdict.end == SearchEnd::no_registration) verdict.reasons.push_back(what_is_shown(view));
  return verdict;
}

void judge_together(const std::vector<std::string>& views, std::vector<SearchVerdict>& verdicts) {
  const auto in_place = std::find_if(verdicts.begin(), verdicts.end(),
                                     [](const SearchVerdict& v) { return v.in_place; });
  for (std::size_t v = 0; in_place != verdicts.end() && v < verdicts.size(); ++v) {
    SearchVerdict& verdict = verdicts[v];
    if (verdict.strange.empty()) continue;
    verdict.end = SearchEnd::look;
    verdict.reasons.clear();
    for (const std::string& sentence : verdict.strange)
      verdict.reasons.push_back(views[v] + ": " + sentence);
    verdict.reasons.push_back(views[v] + ": registered for " + views[in_place - verdicts.begin()] +
                              ", searched with it, is surely this breast");
  }
  const auto failed = [](const SearchVerdict& v) { return v.end == SearchEnd::no_registration; };
  const auto first = std::find_if(verdicts.begin(), verdicts.end(), failed);
  if (first == verdicts.end()) return;
  const std::string beside = views[first - verdicts.begin()] + ", searched with it, has none";
  for (std::size_t v = 0; v < verdicts.size(); ++v) {
    SearchVerdict& verdict = verdicts[v];
    if (failed(verdict)) continue;
    const bool doubtful = verdict.end == SearchEnd::look && !verdict.in_place;
    verdict.end = doubtful ? SearchEnd::no_registration : SearchEnd::look;
    verdict.reasons.push_back(views[v] + (doubtful ? ": no registration: " : ": registered, but ") +
                              beside);
    if (doubtful) verdict.reasons.push_back(what_is_shown(views[v]));
  }
}

}  // namespace mammotwin
