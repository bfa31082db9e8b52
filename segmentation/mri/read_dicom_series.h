#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/files/grid_image.h"
#include "segmentation/mri/series_choice.h"

namespace mammotwin {

struct DicomVolume {
  GridImage image;
  std::vector<std::filesystem::path> files;  ///< those that the volume was made from
  std::vector<std::string> notes;            ///< what was left aside and chosen, in sentences
  std::vector<SeriesRow> series;             ///< what was weighed; empty without a choice
  std::string patient_position;              ///< "HFP"; empty where the header does not say
  bool geometry_known = true;                ///< false: sizes and places were assumed
};

/// Reads one MR series from a folder or a multi-frame file.
///
/// `series` names it by series number or SeriesInstanceUID, `NUMBER:PHASE` also the phase where
/// the series holds several. Without it the only MR series of at least 16 slices is taken; of
/// several the one that choose_series_row says, by their headers and what is seen in the middle of
/// each (a dynamic study is one geometry three times or more); a note and `series` say why. Of
/// several phases the second is taken (in a dynamic series the first after the contrast agent), and
/// a note says so. Throws std::runtime_error with the path in front; patient identifiers and UIDs
/// are never shown.
DicomVolume read_dicom_series(const std::filesystem::path& path,
                              const std::optional<std::string>& series);

}  // namespace mammotwin
