#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <vector>

namespace mammotwin {

/// A plain left MLO mammogram of 40 x 60 pixels of 0.1 mm.
inline void fill_mammogram(DcmDataset& d) {
  d.putAndInsertString(DCM_SOPClassUID, UID_DigitalMammographyXRayImageStorageForPresentation);
  d.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4");
  d.putAndInsertString(DCM_Modality, "MG");
  d.putAndInsertString(DCM_PresentationIntentType, "FOR PRESENTATION");
  d.putAndInsertString(DCM_PatientName, "SECRET^NAME");
  d.putAndInsertString(DCM_PatientID, "4711");
  d.putAndInsertString(DCM_StudyInstanceUID, "1.2.3");
  d.putAndInsertString(DCM_SeriesInstanceUID, "1.2.3.1");
  d.putAndInsertString(DCM_StudyDate, "20200102");
  d.putAndInsertString(DCM_StudyTime, "101112");
  d.putAndInsertString(DCM_ViewPosition, "MLO");
  d.putAndInsertString(DCM_ImageLaterality, "L");
  d.putAndInsertString(DCM_PatientOrientation, "A\\FR");
  d.putAndInsertString(DCM_PositionerType, "MAMMOGRAPHIC");
  d.putAndInsertString(DCM_PositionerPrimaryAngle, "48");
  d.putAndInsertString(DCM_BodyPartThickness, "57");
  d.putAndInsertString(DCM_CompressionForce, "102");
  d.putAndInsertString(DCM_DistanceSourceToDetector, "650");
  d.putAndInsertString(DCM_DistanceSourceToPatient, "633");
  d.putAndInsertString(DCM_EstimatedRadiographicMagnificationFactor, "1.03");
  d.putAndInsertString(DCM_ImagerPixelSpacing, "0.1\\0.1");
  d.putAndInsertString(DCM_BreastImplantPresent, "NO");
  d.putAndInsertString(DCM_PartialView, "NO");
  d.putAndInsertUint16(DCM_Rows, 60);
  d.putAndInsertUint16(DCM_Columns, 40);
  d.putAndInsertUint16(DCM_BitsAllocated, 16);
  d.putAndInsertUint16(DCM_BitsStored, 12);
  d.putAndInsertUint16(DCM_HighBit, 11);
  d.putAndInsertUint16(DCM_PixelRepresentation, 0);
  d.putAndInsertUint16(DCM_SamplesPerPixel, 1);
  d.putAndInsertString(DCM_PhotometricInterpretation, "MONOCHROME2");
  std::vector<Uint16> pixels(40 * 60, 100);
  pixels[0] = 4000;
  d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
}

}  // namespace mammotwin
