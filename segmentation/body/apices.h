#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// How far forward (-y) [mm] the first voxel for which `counts(i, j, k)` lies, one value a column
/// (i, k), i fastest; -infinity where there is none.
template <class T, class Counts>
std::vector<double> column_fronts(const Volume<T>& image, const Counts& counts) {
  std::vector<double> fronts;
  for (int k = 0; k < image.size.z(); ++k)
    for (int i = 0; i < image.size.x(); ++i) {
      int j = 0;
      while (j < image.size.y() && !counts(i, j, k)) ++j;
      fronts.push_back(j < image.size.y() ? -image.position(i, j, k).y()
                                          : -std::numeric_limits<double>::infinity());
    }
  return fronts;
}

/// How far forward each column of x reaches, over the slices `low` to `high`; `fronts`: of `nx`
/// columns a slice.
std::vector<double> front_profile(const std::vector<double>& fronts, int nx, int low, int high);

/// The two most anterior places of a front profile, and the valley between them, as indices.
struct Apices {
  int right = 0, left = 0;  ///< the patient's: x grows to the left
  double valley = 0;        ///< cleft_between them
};

/// `front[i]` is how far forward [mm] the skin reaches at the i-th column of x (-infinity: no
/// skin). Of all second apices the one that stands highest over its valley is taken. Empty if it
/// stands less than 10 mm over it, the two are less than 60 mm apart (`step` is the column width,
/// mm), or neither the valley nor the middle between the two is in the middle third of the skin's
/// width (a breast and an arm).
std::optional<Apices> find_apices(const std::vector<double>& front, double step);

/// The valley between two apices (valley_between). One that is not in the middle third between them
/// lies at the foot of a breast that a coil pressed: where the skin in the middle is nearer to the
/// valley than to the lower apex, a place stands for it that is as much nearer to the middle than
/// the third's end as the valley is farther from it, or the middle itself.
double cleft_between(const std::vector<double>& front, int right, int left);

/// Middle of the columns between two, both included, that lie within 2 mm of the lowest of them: as
/// an index, which may lie between two columns. Columns without skin do not count; `low` if none
/// has any.
double valley_between(const std::vector<double>& front, int low, int high);

}  // namespace mammotwin
