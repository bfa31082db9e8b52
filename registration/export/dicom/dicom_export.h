#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "registration/export/png_file.h"
#include "registration/search/search_ellipse.h"
#include "registration/view/detector.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// A predicted place on one mammogram.
struct AnnotatedMark {
  std::string id;
  Eigen::Vector2d on_detector = Eigen::Vector2d::Zero();   ///< u, v [mm]
  SearchEllipse ellipse;                                   ///< 90 % [mm]
  Eigen::Vector3d prone_in_lps = Eigen::Vector3d::Zero();  ///< in MRI [mm]
  double height_mm = 0;                                    ///< above the support
  std::optional<int> slice = {};                           ///< of a tomosynthesis volume, from 1
};

/// Each writes a DICOM object of the study of `mammogram` (a DICOM file with pixels laid out as
/// `detector.pixels` says) or of the MRI, whose patient and study attributes it takes. Dates and
/// times of the object are those of its making (of SOURCE_DATE_EPOCH where the environment has it);
/// its unique identifiers derive from them, `mammogram`, the kind of object and `key` ("cc"). Throw
/// std::runtime_error naming the file that cannot be read or written.

/// Grayscale softcopy presentation state: each mark's ellipse and name drawn on the mammogram, of
/// a tomosynthesis volume on its slice.
void write_presentation_state(const std::filesystem::path& path,
                              const std::filesystem::path& mammogram, const Detector& detector,
                              const std::vector<AnnotatedMark>& marks, const std::string& key);

/// Structured report, imaging measurement report (TID 1500): a measurement group a mark with its
/// place on the detector and its ellipse, each with its coordinates on the mammogram, the breast's
/// side, and its place in the prone MRI (in the tracking identifier).
void write_measurement_report(const std::filesystem::path& path,
                              const std::filesystem::path& mammogram, const Detector& detector,
                              Side side, const std::vector<AnnotatedMark>& marks,
                              const std::string& key);

/// The simulated view as a secondary capture with SIMULATED burned in above it, so that nobody
/// takes it for an exposure. `orientation` is its PatientOrientation ("A\\F"). Throws
/// std::invalid_argument for a picture too narrow for the word.
void write_simulated_view(const std::filesystem::path& path, const std::filesystem::path& mammogram,
                          const GreyPixels& bare, double spacing_mm, const std::string& orientation,
                          const std::string& key);

/// Is there anything for a segmentation of lesions to show?
bool has_lesion_voxels(const Segmentation& segmentation);

/// The lesions as a binary segmentation (SEG) of the MRI, a segment each, in the frame of reference
/// of `slices`, the files of its series, on the grid of the labels; one without voxels is left out.
void write_lesion_segmentation(const std::filesystem::path& path,
                               const std::vector<std::filesystem::path>& slices,
                               const Segmentation& segmentation);

}  // namespace mammotwin
