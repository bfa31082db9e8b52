#include "registration/mammogram/mammogram_header.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmimgle/dcmimage.h>
#include <dcmtk/dcmjpeg/djdecode.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace mammotwin {
namespace {

/// Upper case without blanks at the ends.
std::string tidy(std::string text) {
  const auto blank = [](unsigned char c) { return std::isspace(c) || c == 0; };
  while (!text.empty() && blank(text.back())) text.pop_back();
  while (!text.empty() && blank(text.front())) text.erase(text.begin());
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string text_of(DcmItem& item, const DcmTagKey& tag) {
  OFString value;
  return item.findAndGetOFStringArray(tag, value).good() ? tidy(value.c_str()) : "";
}

std::vector<std::string> texts_of(DcmItem& item, const DcmTagKey& tag) {
  std::vector<std::string> values;
  OFString value;
  for (unsigned long n = 0; item.findAndGetOFString(tag, value, n).good(); ++n)
    values.push_back(tidy(value.c_str()));
  return values;
}

std::vector<double> numbers_of(DcmItem& item, const DcmTagKey& tag) {
  std::vector<double> values;
  Float64 value;
  for (unsigned long n = 0; item.findAndGetFloat64(tag, value, n).good(); ++n)
    values.push_back(value);
  return values;
}

std::optional<double> number_of(DcmItem& item, const DcmTagKey& tag) {
  const std::vector<double> values = numbers_of(item, tag);
  if (values.empty()) return std::nullopt;
  return values.front();
}

std::optional<int> count_of(DcmItem& item, const DcmTagKey& tag) {
  long value = 0;
  Uint16 small = 0;
  if (item.findAndGetUint16(tag, small).good()) return small;
  OFString text;
  if (item.findAndGetOFString(tag, text).bad()) return std::nullopt;
  value = std::strtol(text.c_str(), nullptr, 10);
  return static_cast<int>(value);
}

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

DcmFileFormat load(const std::filesystem::path& path) {
  DcmFileFormat file;
  const OFCondition status = file.loadFile(path.c_str());
  if (status.bad())
    throw std::runtime_error(path.filename().string() +
                             ": not readable as DICOM: " + status.text());
  return file;
}

/// Decoders for JPEG, registered for the process once.
void register_decoders() {
  static const bool once = [] {
    DJDecoderRegistration::registerCodecs();
    return true;
  }();
  (void)once;
}

}  // namespace

bool is_dicom(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  char magic[132] = {};
  in.read(magic, sizeof magic);
  return in && std::string(magic + 128, 4) == "DICM";
}

MammogramHeader read_mammogram_header(const std::filesystem::path& path) {
  DcmFileFormat file = load(path);
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
  h.magnification = number_of(d, DCM_EstimatedRadiographicMagnificationFactor);
  h.imager_spacing_mm = numbers_of(d, DCM_ImagerPixelSpacing);
  h.pixel_spacing_mm = numbers_of(d, DCM_PixelSpacing);
  h.rows = count_of(d, DCM_Rows);
  h.columns = count_of(d, DCM_Columns);
  h.frames = count_of(d, DCM_NumberOfFrames);
  return h;
}

MammogramImage read_mammogram_dicom(const std::filesystem::path& path) {
  register_decoders();
  DcmFileFormat file = load(path);
  DcmDataset& dataset = *file.getDataset();
  const bool counts = text_of(dataset, DCM_PresentationIntentType) == "FOR PROCESSING";
  const bool inverted = text_of(dataset, DCM_PhotometricInterpretation) == "MONOCHROME1";
  const DicomImage decoded(&dataset, dataset.getOriginalXfer(), CIF_IgnoreModalityTransformation);
  const DiPixel* pixels = decoded.getStatus() == EIS_Normal ? decoded.getInterData() : nullptr;
  if (!pixels)
    throw std::runtime_error(path.filename().string() + ": (7FE0,0010) pixel data: " +
                             DicomImage::getString(decoded.getStatus()));
  MammogramImage image{
      static_cast<int>(decoded.getWidth()), static_cast<int>(decoded.getHeight()), {}};
  image.grey.resize(static_cast<std::size_t>(image.columns) * image.rows);
  const auto take = [&](const auto* from) {
    for (std::size_t i = 0; i < image.grey.size(); ++i) image.grey[i] = static_cast<float>(from[i]);
  };
  switch (pixels->getRepresentation()) {
    case EPR_Uint8:
      take(static_cast<const Uint8*>(pixels->getData()));
      break;
    case EPR_Sint8:
      take(static_cast<const Sint8*>(pixels->getData()));
      break;
    case EPR_Uint16:
      take(static_cast<const Uint16*>(pixels->getData()));
      break;
    case EPR_Sint16:
      take(static_cast<const Sint16*>(pixels->getData()));
      break;
    case EPR_Uint32:
      take(static_cast<const Uint32*>(pixels->getData()));
      break;
    case EPR_Sint32:
      take(static_cast<const Sint32*>(pixels->getData()));
      break;
  }
  const float most = *std::max_element(image.grey.begin(), image.grey.end());
  for (float& grey : image.grey) {
    if (counts && !inverted)
      grey = std::log(std::max(1.f, most) / std::max(1.f, grey));
    else if (inverted)
      grey = most - grey;
  }
  return image;
}

}  // namespace mammotwin
