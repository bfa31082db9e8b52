#include "registration/mammogram/mammogram_header.h"

#include <fstream>

#include "registration/mammogram/dicom_values.h"
#include "registration/mammogram/tomosynthesis_header.h"

namespace mammotwin {
namespace {

void read_view_code(DcmItem& dataset, MammogramHeader& header) {
  DcmItem* code = nullptr;
  if (dataset.findAndGetSequenceItem(DCM_ViewCodeSequence, code).bad()) return;
  header.view_code = text_of(*code, DCM_CodeValue);
  header.view_code_meaning = text_of(*code, DCM_CodeMeaning);
  DcmItem* modifier = nullptr;
  for (long n = 0; code->findAndGetSequenceItem(DCM_ViewModifierCodeSequence, modifier, n).good();
       ++n)
    header.view_modifiers.push_back(text_of(*modifier, DCM_CodeMeaning));
}

}  // namespace

bool is_dicom(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  char magic[132] = {};
  in.read(magic, sizeof magic);
  return in && std::string(magic + 128, 4) == "DICM";
}

MammogramHeader read_mammogram_header(const std::filesystem::path& path) {
  DcmFileFormat file = load_dicom(path);
  DcmDataset& d = *file.getDataset();
  MammogramHeader h;
  h.modality = text_of(d, DCM_Modality);
  h.positioner_type = text_of(d, DCM_PositionerType);
  h.presentation_intent = text_of(d, DCM_PresentationIntentType);
  h.paddle = text_of(d, DCM_PaddleDescription);
  h.implant = text_of(d, DCM_BreastImplantPresent);
  h.partial_view = text_of(d, DCM_PartialView);
  h.view_position = text_of(d, DCM_ViewPosition);
  read_view_code(d, h);
  h.image_laterality = text_of(d, DCM_ImageLaterality);
  h.laterality = text_of(d, DCM_Laterality);
  h.patient_orientation = texts_of(d, DCM_PatientOrientation);
  h.primary_angle_deg = number_of(d, DCM_PositionerPrimaryAngle);
  h.thickness_mm = number_of(d, DCM_BodyPartThickness);
  h.force = number_of(d, DCM_CompressionForce);
  h.source_to_detector_mm = number_of(d, DCM_DistanceSourceToDetector);
  h.source_to_patient_mm = number_of(d, DCM_DistanceSourceToPatient);
  h.image_type = texts_of(d, DCM_ImageType);
  h.element_spacing_mm = numbers_of(d, DCM_DetectorElementSpacing);
  h.collimated_left = count_of(d, DCM_CollimatorLeftVerticalEdge);
  h.collimated_right = count_of(d, DCM_CollimatorRightVerticalEdge);
  h.magnification = number_of(d, DCM_EstimatedRadiographicMagnificationFactor);
  h.imager_spacing_mm = numbers_of(d, DCM_ImagerPixelSpacing);
  h.pixel_spacing_mm = numbers_of(d, DCM_PixelSpacing);
  h.rows = count_of(d, DCM_Rows);
  h.columns = count_of(d, DCM_Columns);
  h.frames = count_of(d, DCM_NumberOfFrames);
  if (text_of(d, DCM_SOPClassUID) == UID_BreastTomosynthesisImageStorage)
    read_tomosynthesis(d, path.filename().string(), h);
  return h;
}

}  // namespace mammotwin
