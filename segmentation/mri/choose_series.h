#pragma once

#include <string>
#include <vector>

#include "segmentation/mri/dicom_series.h"
#include "segmentation/mri/series_choice.h"

namespace mammotwin {

/// The series that is read, and why.
struct ChosenSeries {
  DicomSeries series;
  std::vector<SeriesRow> weighed;  ///< empty without a choice
  std::vector<std::string> notes;  ///< in sentences
};

/// `wanted`: "", series number or SeriesInstanceUID, either with ":PHASE" behind it;
/// read_dicom_series.h has the rule. Throws std::runtime_error where none or several serve or
/// slices are of several patients. `all` must not be empty.
ChosenSeries choose_series(const std::vector<DicomSeries>& all, const std::string& wanted);

}  // namespace mammotwin
