#pragma once

#include <string>

#include "registration/mammogram/dicom_values.h"
#include "registration/mammogram/mammogram_header.h"

namespace mammotwin {

/// Adds what a Breast Tomosynthesis Image (PS3.3 A.55) keeps in sequences: pixel spacing, places of
/// its slices, laterality and orientation from the functional groups; thickness, force, distances
/// and the middle of the positioner's angles from the acquisition (C.8.21.3.4). What stands at the
/// top of the data set, as some vendors have it, goes before these. Throws std::runtime_error
/// naming `file` where there are no functional groups.
void read_tomosynthesis(DcmDataset& dataset, const std::string& file, MammogramHeader& header);

}  // namespace mammotwin
