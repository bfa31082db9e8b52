#pragma once

namespace mammotwin {

/// Fractions of a step to try, in search of the place where the slope along it vanishes: the whole
/// step first; then inside the bracket between the last place short of it and the last beyond it.
/// A trial costs a residual, the next step a factorisation, so a good fraction is worth several.
class LineSearch {
 public:
  /// `slope`: of the energy along the step at its start.
  explicit LineSearch(double slope);

  double fraction() const { return fraction_; }  ///< to try next
  bool exhausted() const;

  /// Is a trial with this slope near enough, or the whole step?
  bool good_enough(double slope) const;
  /// Has a trial with this slope passed the place by too much to be taken at all?
  bool overshoots(double slope) const;

  void go_farther();           ///< the trial fell short
  void go_back(double slope);  ///< it overshot, and the slope is known
  void go_back();              ///< it was not even valid

 private:
  void try_within(double share);

  const double first_;  ///< |slope| at the start
  double low_ = 0, high_ = 1, fraction_ = 1;
  int trials_ = 0;
};

}  // namespace mammotwin
