#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/files/slice_stack.h"

namespace mammotwin {

/// What is kept of a DICOM header: geometry and what tells series and phases apart. Nothing here
/// that names the patient, and no date.
struct DicomSlice {
  std::filesystem::path file;
  int frame = 0;  ///< in a multi-frame object
  SlicePlacement placement;
  std::string modality;                ///< "MR" serves
  std::string series_uid, patient_id;  ///< compared, never shown
  std::string series_number;
  std::string image_type;        ///< "ORIGINAL\\PRIMARY", "DERIVED\\SECONDARY\\..."
  std::string acquisition_time;  ///< compared, never shown
  bool geometry_known = true;    ///< false: the header does not say where the frames stand
  std::string patient_position;  ///< as the header has it, "HFP" for head first, prone
  std::string phase;             ///< equal within one acquisition of a series in several phases
};

/// Slices of one DICOM file (one, or one a frame); empty if the file is not a DICOM image.
std::vector<DicomSlice> read_dicom_slices(const std::filesystem::path& file);

/// Pixel values of one file with rescale slope and intercept applied, frame after frame.
/// Throws std::runtime_error if the pixels cannot be decoded or are not one grey value each.
std::vector<float> read_dicom_pixels(const std::filesystem::path& file);

}  // namespace mammotwin
