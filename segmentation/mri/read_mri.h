#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/image/volume.h"
#include "segmentation/mri/series_choice.h"

namespace mammotwin {

/// A magnetic resonance image on the LPS grid, and where it came from.
struct Mri {
  Volume<float> image;                       ///< [scanner units]
  std::vector<std::filesystem::path> files;  ///< what was read
  std::vector<std::string> notes;            ///< what the reader chose or changed, in sentences
  std::vector<SeriesRow> series;             ///< of which one was chosen; empty without a choice
  std::string patient_position;              ///< DICOM's code, "HFP"; empty where not known
  bool geometry_known = true;  ///< false: the header gives no places; axial, 1 mm was assumed
};

/// Reads a folder with a DICOM series, a (multi-frame) DICOM file, or NIfTI (.nii, .nii.gz), NRRD
/// (.nrrd, .nhdr) or MetaImage (.mha, .mhd). `series` as in read_dicom_series.h.
///
/// Throws std::runtime_error naming the path, what was expected and what was found: missing,
/// empty, truncated, two-dimensional, colour, not finite, of implausible size or spacing.
Mri read_mri(const std::filesystem::path& path,
             const std::optional<std::string>& series = std::nullopt);

}  // namespace mammotwin
