#include "pipeline/synthesize/views/exam_dicom.h"

#include <algorithm>
#include <cmath>

#include "pipeline/synthesize/views/dicom_codes.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using namespace dicom;

using Tags = std::initializer_list<std::pair<DcmTagKey, std::string>>;

constexpr int kMammogramBits = 14;

void put_all(DcmItem& item, const Tags& tags) {
  for (const auto& [tag, value] : tags) put(item, tag, value);
}

/// Who is imaged, by whom, in which study; `what` tells apart objects of one exam.
void put_exam(DcmItem& object, int seed, const std::string& study, const std::string& what) {
  const std::string exam = "made-up exam " + std::to_string(seed);
  put_all(object, {{DCM_PatientName, "MADE-UP^PATIENT"},
                   {DCM_PatientID, "MADE-UP-" + std::to_string(seed)},
                   {DCM_PatientBirthDate, "19700101"},
                   {DCM_PatientSex, "F"},
                   {DCM_StudyInstanceUID, derived_uid(exam + study)},
                   {DCM_StudyDate, "20200102"},
                   {DCM_StudyTime, "100000"},
                   {DCM_StudyID, "1"},
                   {DCM_AccessionNumber, "1"},
                   {DCM_ReferringPhysicianName, ""},
                   {DCM_SeriesNumber, "1"},
                   {DCM_InstanceNumber, "1"},
                   {DCM_SOPInstanceUID, derived_uid(exam + what)},
                   {DCM_Manufacturer, kMaker},
                   {DCM_ManufacturerModelName, "synthetic"},
                   {DCM_DeviceSerialNumber, "0"},
                   {DCM_SoftwareVersions, "1"}});
}

void put_pixels(DcmItem& object, int columns, int rows, int bits,
                const std::vector<std::uint16_t>& grey) {
  const std::pair<DcmTagKey, int> numbers[] = {{DCM_SamplesPerPixel, 1},    {DCM_Rows, rows},
                                               {DCM_Columns, columns},      {DCM_BitsAllocated, 16},
                                               {DCM_BitsStored, bits},      {DCM_HighBit, bits - 1},
                                               {DCM_PixelRepresentation, 0}};
  for (const auto& [tag, value] : numbers)
    object.putAndInsertUint16(tag, static_cast<Uint16>(value));
  put(object, DCM_PhotometricInterpretation, "MONOCHROME2");
  object.putAndInsertUint16Array(DCM_PixelData, grey.data(), grey.size());
}

void fill_slice(const Volume<std::int16_t>& image, int k, int seed, DcmItem& object) {
  const Eigen::Vector3d at = image.position(0, 0, k);
  put_exam(object, seed, "MR", "MR" + std::to_string(k));
  put_all(object, {{DCM_SOPClassUID, UID_MRImageStorage},
                   {DCM_Modality, "MR"},
                   {DCM_SeriesInstanceUID, derived_uid("made-up series " + std::to_string(seed))},
                   {DCM_SeriesDescription, "T1 after contrast agent, fat suppressed, synthetic"},
                   {DCM_FrameOfReferenceUID, derived_uid("made-up frame " + std::to_string(seed))},
                   {DCM_PositionReferenceIndicator, ""},
                   {DCM_InstanceNumber, std::to_string(k + 1)},
                   {DCM_ImageType, "ORIGINAL\\PRIMARY\\OTHER"},
                   {DCM_PatientPosition, "HFP"},
                   {DCM_BodyPartExamined, "BREAST"},
                   {DCM_Laterality, ""},
                   {DCM_ScanningSequence, "GR"},
                   {DCM_SequenceVariant, "SP"},
                   {DCM_ScanOptions, "FS"},
                   {DCM_MRAcquisitionType, "3D"},
                   {DCM_RepetitionTime, "5"},
                   {DCM_EchoTime, "2"},
                   {DCM_EchoTrainLength, "1"},
                   {DCM_SliceThickness, number(image.spacing.z())},
                   {DCM_PixelSpacing, number(image.spacing.y()) + "\\" + number(image.spacing.x())},
                   {DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0"},
                   {DCM_ImagePositionPatient,
                    number(at.x()) + "\\" + number(at.y()) + "\\" + number(at.z())}});
  std::vector<std::uint16_t> grey;
  for (int j = 0; j < image.size.y(); ++j)
    for (int i = 0; i < image.size.x(); ++i)
      grey.push_back(static_cast<std::uint16_t>(std::max<std::int16_t>(image(i, j, k), 0)));
  put_pixels(object, image.size.x(), image.size.y(), 16, grey);
}

void put_view(const Detector& detector, const ExamView& view, DcmItem& object) {
  const bool left = view.side == Side::left, cc = view.name == "cc";
  const std::string spacing =
      number(detector.pixels->spacing_mm) + "\\" + number(detector.pixels->spacing_mm);
  put_all(
      object,
      {{DCM_Modality, "MG"},
       {DCM_PresentationIntentType, "FOR PRESENTATION"},
       {DCM_BodyPartExamined, "BREAST"},
       {DCM_ImageType, "DERIVED\\PRIMARY"},
       {DCM_ViewPosition, cc ? "CC" : "MLO"},
       {DCM_ImageLaterality, left ? "L" : "R"},
       {DCM_PatientOrientation, std::string(left ? "A\\" : "P\\") + (!cc    ? (left ? "FR" : "FL")
                                                                     : left ? "R"
                                                                            : "L")},
       {DCM_PositionerType, "MAMMOGRAPHIC"},
       {DCM_PositionerPrimaryAngle, number(view.angle_deg)},
       {DCM_BodyPartThickness, number(view.thickness_mm)},
       {DCM_CompressionForce, "100"},
       {DCM_DistanceSourceToDetector, number(detector.source_distance_mm)},
       {DCM_DistanceSourceToPatient, number(detector.source_distance_mm - detector.support_gap_mm)},
       {DCM_EstimatedRadiographicMagnificationFactor, "1"},
       {DCM_ImagerPixelSpacing, spacing},
       {DCM_PixelIntensityRelationship, "LOG"},
       {DCM_RescaleIntercept, "0"},
       {DCM_RescaleSlope, "1"},
       {DCM_RescaleType, "US"},
       {DCM_PresentationLUTShape, "IDENTITY"},
       {DCM_LossyImageCompression, "00"},
       {DCM_BurnedInAnnotation, "NO"},
       {DCM_DetectorType, "DIRECT"},
       {DCM_OrganExposed, "BREAST"},
       {DCM_BreastImplantPresent, "NO"},
       {DCM_PartialView, "NO"},
       {DCM_WindowCenter, "8192"},
       {DCM_WindowWidth, "16384"}});
  object.putAndInsertSint16(DCM_PixelIntensityRelationshipSign, 1);
  put_view_code(object, view.name);
  put_code(object, DCM_AnatomicRegionSequence, "76752008", "Breast");
  object.insertEmptyElement(DCM_AcquisitionContextSequence);
}

}  // namespace

void write_mri_series(const fs::path& folder, const Volume<std::int16_t>& image, int seed) {
  fs::create_directories(folder);
  for (int k = 0; k < image.size.z(); ++k) {
    DcmFileFormat file;
    fill_slice(image, k, seed, *file.getDataset());
    save(file, folder / (std::to_string(k + 1) + ".dcm"));
  }
}

void write_mammogram(const fs::path& path, const GreyPixels& pixels, const Detector& detector,
                     const ExamView& view, int seed) {
  DcmFileFormat file;
  DcmItem& object = *file.getDataset();
  put_exam(object, seed, "MG", "MG" + view.name);
  put(object, DCM_SOPClassUID, UID_DigitalMammographyXRayImageStorageForPresentation);
  put(object, DCM_SeriesInstanceUID,
      derived_uid("made-up mammograms " + std::to_string(seed) + view.name));
  put_view(detector, view, object);
  std::vector<std::uint16_t> grey = pixels.grey;
  for (std::uint16_t& g : grey) g >>= 16 - kMammogramBits;
  put_pixels(object, pixels.columns, pixels.rows, kMammogramBits, grey);
  save(file, path);
}

}  // namespace mammotwin
