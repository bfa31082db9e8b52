#pragma once

#include <optional>
#include <vector>

namespace mammotwin {

/// The two most anterior places of a front profile, and the valley between them, as indices.
struct Apices {
  int right = 0, left = 0;  ///< the patient's: x grows to the left
  double valley = 0;        ///< middle of the plateau between them
};

/// `front[i]` is how far forward [mm] the skin reaches at the i-th column of x (-infinity: no
/// skin). Of all second apices the one that stands highest over its valley is taken. Empty if it
/// stands less than 10 mm over it, the two are less than 60 mm apart (`step` is the column width,
/// mm), or the valley is not in the middle third of the skin's width (a breast and an arm).
std::optional<Apices> find_apices(const std::vector<double>& front, double step);

/// Middle of the columns between two, both included, that lie within 2 mm of the lowest of them: as
/// an index, which may lie between two columns. Columns without skin do not count; `low` if none
/// has any.
double valley_between(const std::vector<double>& front, int low, int high);

}  // namespace mammotwin
