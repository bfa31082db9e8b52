#include "solver/newton/line_search.h"

#include <algorithm>
#include <cmath>

namespace mammotwin {

namespace {

constexpr int kMostTrials = 14;
constexpr double kNarrow = 0.1;                          // of the bracket's upper end
constexpr double kMostOvershoot = 0.9, kMostLeft = 0.5;  // of the slope at the start

}  // namespace

LineSearch::LineSearch(double slope) : first_(std::abs(slope)) {}

bool LineSearch::exhausted() const {
  return trials_ >= kMostTrials || (trials_ > 0 && high_ - low_ < kNarrow * high_);
}

bool LineSearch::good_enough(double slope) const {
  return fraction_ == 1 || slope >= -kMostLeft * first_;
}

bool LineSearch::overshoots(double slope) const { return slope > kMostOvershoot * first_; }

void LineSearch::go_farther() {
  low_ = fraction_;
  try_within(0.5);
}

/// Linear between the slopes of the start and of the trial.
void LineSearch::go_back(double slope) {
  constexpr double least = 0.1, most = 0.6;
  high_ = fraction_;
  try_within(std::clamp(first_ / (first_ + std::max(slope, 0.0)), least, most));
}

void LineSearch::go_back() {
  high_ = fraction_;
  try_within(0.3);
}

void LineSearch::try_within(double share) {
  fraction_ = low_ + share * (high_ - low_);
  ++trials_;
}

}  // namespace mammotwin
