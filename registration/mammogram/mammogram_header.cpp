#include "registration/mammogram/mammogram_header.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmimage/diregist.h>
#include <dcmtk/dcmimgle/dcmimage.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "registration/mammogram/detector_counts.h"

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

/// Of any representation: texts, binary integers of either sign, reals.
std::vector<double> numbers_of(DcmItem& item, const DcmTagKey& tag) {
  std::vector<double> values;
  for (const std::string& text : texts_of(item, tag)) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str()) break;
    values.push_back(value);
  }
  return values;
}

std::optional<double> number_of(DcmItem& item, const DcmTagKey& tag) {
  const std::vector<double> values = numbers_of(item, tag);
  if (values.empty()) return std::nullopt;
  return values.front();
}

std::optional<int> count_of(DcmItem& item, const DcmTagKey& tag) {
  const auto value = number_of(item, tag);
  if (!value) return std::nullopt;
  return static_cast<int>(*value);
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

/// Decoders for JPEG, JPEG-LS and RLE, registered for the process once.
void register_decoders() {
  static const bool once = [] {
    DJDecoderRegistration::registerCodecs();
    DJLSDecoderRegistration::registerCodecs();
    DcmRLEDecoderRegistration::registerCodecs();
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
  return h;
}

namespace {

/// Refuses by name what no decoder here can read.
void check_compression(const DcmDataset& dataset, const std::string& file) {
  const E_TransferSyntax syntax = dataset.getOriginalXfer();
  for (const E_TransferSyntax jpeg_2000 :
       {EXS_JPEG2000, EXS_JPEG2000LosslessOnly, EXS_JPEG2000Multicomponent,
        EXS_JPEG2000MulticomponentLosslessOnly})
    if (syntax == jpeg_2000)
      throw std::runtime_error(file +
                               ": its pixels are JPEG 2000, which is not read here; expected "
                               "uncompressed, RLE, JPEG or JPEG-LS: have it sent so, or convert it "
                               "(gdcmconv --raw)");
}

template <class From>
void copy(const void* from, std::vector<float>& to) {
  const From* values = static_cast<const From*>(from);
  std::copy(values, values + to.size(), to.begin());
}

/// Values as they are stored.
void take_grey(const DiPixel& pixels, std::vector<float>& grey) {
  switch (pixels.getRepresentation()) {
    case EPR_Uint8:
      return copy<Uint8>(pixels.getData(), grey);
    case EPR_Sint8:
      return copy<Sint8>(pixels.getData(), grey);
    case EPR_Uint16:
      return copy<Uint16>(pixels.getData(), grey);
    case EPR_Sint16:
      return copy<Sint16>(pixels.getData(), grey);
    case EPR_Uint32:
      return copy<Uint32>(pixels.getData(), grey);
    case EPR_Sint32:
      return copy<Sint32>(pixels.getData(), grey);
  }
}

/// Colour of which all channels are equal is grey.
void take_colour(DicomImage& decoded, std::vector<float>& grey, const std::string& file) {
  constexpr int kBits = 8;
  constexpr std::size_t kChannels = 3;
  std::vector<Uint8> colour(decoded.getOutputDataSize(kBits));
  if (colour.size() != kChannels * grey.size() ||
      !decoded.getOutputData(colour.data(), colour.size(), kBits))
    throw std::runtime_error(file + ": (7FE0,0010) pixel data: colour that cannot be read");
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const Uint8* c = &colour[kChannels * i];
    if (c[0] != c[1] || c[1] != c[2])
      throw std::runtime_error(file +
                               ": (0028,0004) PhotometricInterpretation is colour, and its "
                               "channels differ; expected a grey mammogram");
    grey[i] = c[0];
  }
}

/// Indices of pixels that the header calls padding.
std::vector<std::size_t> padding_of(DcmDataset& dataset, const std::vector<float>& grey) {
  const auto value = number_of(dataset, DCM_PixelPaddingValue);
  std::vector<std::size_t> padding;
  if (!value) return padding;
  const double limit = number_of(dataset, DCM_PixelPaddingRangeLimit).value_or(*value);
  const auto [low, high] = std::minmax(*value, limit);
  for (std::size_t i = 0; i < grey.size(); ++i)
    if (grey[i] >= low && grey[i] <= high) padding.push_back(i);
  return padding;
}

CountsEncoding counts_encoding(DcmDataset& dataset) {
  CountsEncoding encoding;
  encoding.logarithmic = text_of(dataset, DCM_PixelIntensityRelationship) == "LOG";
  const auto sign = number_of(dataset, DCM_PixelIntensityRelationshipSign);
  if (sign) encoding.brighter_is_more = *sign > 0;
  if (const auto bits = number_of(dataset, DCM_BitsStored))
    encoding.full_scale = std::pow(2, *bits) - 1;
  return encoding;
}

}  // namespace

MammogramImage read_mammogram_dicom(const std::filesystem::path& path) {
  register_decoders();
  const std::string name = path.filename().string();
  DcmFileFormat file = load(path);
  DcmDataset& dataset = *file.getDataset();
  check_compression(dataset, name);
  DicomImage decoded(&dataset, dataset.getOriginalXfer(), CIF_IgnoreModalityTransformation);
  if (decoded.getStatus() != EIS_Normal)
    throw std::runtime_error(
        name + ": (7FE0,0010) pixel data: " + DicomImage::getString(decoded.getStatus()));
  MammogramImage image{
      static_cast<int>(decoded.getWidth()), static_cast<int>(decoded.getHeight()), {}};
  image.grey.resize(static_cast<std::size_t>(image.columns) * image.rows);
  if (decoded.isMonochrome())
    take_grey(*decoded.getInterData(), image.grey);
  else
    take_colour(decoded, image.grey, name);
  const std::vector<std::size_t> padding = padding_of(dataset, image.grey);
  const bool inverted = text_of(dataset, DCM_PhotometricInterpretation) == "MONOCHROME1";
  if (text_of(dataset, DCM_PresentationIntentType) == "FOR PROCESSING") {
    absorption_from_counts(image, counts_encoding(dataset));
  } else if (inverted) {
    const float most = *std::max_element(image.grey.begin(), image.grey.end());
    for (float& grey : image.grey) grey = most - grey;
  }
  const float air = *std::min_element(image.grey.begin(), image.grey.end());
  for (const std::size_t i : padding) image.grey[i] = air;
  return image;
}

}  // namespace mammotwin
