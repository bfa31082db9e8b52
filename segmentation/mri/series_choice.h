#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/mri/series_look.h"

namespace mammotwin {

/// One series of a folder and what became of it.
struct SeriesRow {
  std::string uid;     ///< SeriesInstanceUID, for us alone
  std::string number;  ///< "9"; what else a header calls it may name somebody
  std::size_t slices = 0;
  Eigen::Vector3d voxel_mm = Eigen::Vector3d::Zero();
  double covers_mm = 0;      ///< from the first slice to the last
  bool is_computed = false;  ///< a subtraction, projection, map of other images
  double seconds = 0;        ///< after the first series of the table
  int phase = 0;             ///< 1, 2, ... in the dynamic study; 0: not of it
  std::optional<SeriesLook> look;
  bool is_read = false;
  bool is_before_agent = false;  ///< the phase before the one that is read
  bool is_compared = false;      ///< the chest wall found in it with that in the one that is read
  std::string reason;            ///< why it is read or not
};

/// Says which row is read, and of each why. Those left out, unless that leaves none, in this order:
/// computed from other images; less than 100 mm of the body; voxels of over 2.4 mm, which lose the
/// skin; fat less than 8 times as bright as noise; not of the dynamic study, where there is one
/// (its phases; a later series' lesions have washed out); voxels a tenth larger than the finest's;
/// fewer slices. Of the rest the second in time is read: the first after the contrast agent; the
/// first, where both are phases of a dynamic study, is marked as before it.
std::size_t choose_series_row(std::vector<SeriesRow>& rows);

/// Which other row shows the chest wall independently of the one that is read, if any: of those
/// looked at that are not computed, cover 100 mm, have voxels of at most 4 mm and fat at least 8
/// times as bright as noise, one with fat suppressed where the read one's is not or the other way
/// round; of several the nearest in time. Marks it.
std::optional<std::size_t> choose_compared_row(std::vector<SeriesRow>& rows, std::size_t read);

nlohmann::json to_json(const std::vector<SeriesRow>& rows);

}  // namespace mammotwin
