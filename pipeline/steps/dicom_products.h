#pragma once

#include "pipeline/patient/patient.h"
#include "pipeline/steps/registration_products.h"
#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {

/// dicom/cc_gsps.dcm, cc_sr.dcm and cc_simulated.dcm for a view "cc", in the study of its mammogram
/// and with its patient attributes (registration/export/dicom/dicom_export.h): only where the
/// patient's file asks for them.
void write_dicom_products(const PredictedView& view, const DetectorImage& shown,
                          const std::filesystem::path& mammogram, Products& products);

/// dicom/lesions_seg.dcm, in the study of the MRI: where that is DICOM and a lesion has voxels.
void write_dicom_segmentation(const Patient& patient, const Segmentation& segmentation,
                              Products& products);

}  // namespace mammotwin
