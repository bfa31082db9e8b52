#include "registration/mammogram/mammogram_pixels.h"

#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmimage/diregist.h>
#include <dcmtk/dcmimgle/dcmimage.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "registration/mammogram/detector_counts.h"
#include "registration/mammogram/dicom_values.h"
#include "registration/mammogram/mammogram_header.h"
#include "registration/mammogram/mammogram_picture.h"

namespace mammotwin {
namespace {

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

/// What the library would print of a header stands in our own messages.
void keep_library_silent() {
  static const bool done = (OFLog::configure(OFLogger::OFF_LOG_LEVEL), true);
  (void)done;
}

/// Values of one frame as they are stored.
MammogramImage decoded_frame(DcmDataset& dataset, int frame, const std::string& file) {
  constexpr unsigned long kOne = 1;
  keep_library_silent();
  DicomImage decoded(&dataset, dataset.getOriginalXfer(),
                     CIF_IgnoreModalityTransformation | CIF_UsePartialAccessToPixelData,
                     static_cast<unsigned long>(frame), kOne);
  if (decoded.getStatus() != EIS_Normal)
    throw std::runtime_error(
        file + ": (7FE0,0010) pixel data: " + DicomImage::getString(decoded.getStatus()));
  MammogramImage image{
      static_cast<int>(decoded.getWidth()), static_cast<int>(decoded.getHeight()), {}};
  image.grey.resize(static_cast<std::size_t>(image.columns) * image.rows);
  if (decoded.isMonochrome())
    take_grey(*decoded.getInterData(), image.grey);
  else
    take_colour(decoded, image.grey, file);
  return image;
}

MammogramImage mean_of_frames(DcmDataset& dataset, int first, int count, const std::string& file) {
  MammogramImage mean = decoded_frame(dataset, first, file);
  for (int frame = first + 1; frame < first + count; ++frame) {
    const MammogramImage next = decoded_frame(dataset, frame, file);
    for (std::size_t i = 0; i < mean.grey.size(); ++i) mean.grey[i] += next.grey[i];
  }
  for (float& grey : mean.grey) grey /= static_cast<float>(count);
  return mean;
}

/// Dense tissue bright, padding as dark as air.
void turn_to_absorption(MammogramImage& image, DcmDataset& dataset) {
  const std::vector<std::size_t> padding = padding_of(dataset, image.grey);
  if (text_of(dataset, DCM_PresentationIntentType) == "FOR PROCESSING") {
    absorption_from_counts(image, counts_encoding(dataset));
  } else if (text_of(dataset, DCM_PhotometricInterpretation) == "MONOCHROME1") {
    const float most = *std::max_element(image.grey.begin(), image.grey.end());
    for (float& grey : image.grey) grey = most - grey;
  }
  const float air = *std::min_element(image.grey.begin(), image.grey.end());
  for (const std::size_t i : padding) image.grey[i] = air;
}

MammogramImage read_frames(const std::filesystem::path& path, std::optional<int> slice) {
  register_decoders();
  const std::string name = path.filename().string();
  DcmFileFormat file = load_dicom(path);
  DcmDataset& dataset = *file.getDataset();
  check_compression(dataset, name);
  const int frames = std::max(1, count_of(dataset, DCM_NumberOfFrames).value_or(1));
  if (slice && (*slice < 1 || *slice > frames))
    throw std::runtime_error(name + ": slice " + std::to_string(*slice) + " is asked for of " +
                             std::to_string(frames));
  MammogramImage image = slice ? mean_of_frames(dataset, *slice - 1, 1, name)
                               : mean_of_frames(dataset, 0, frames, name);
  turn_to_absorption(image, dataset);
  return image;
}

}  // namespace

MammogramImage read_mammogram_dicom(const std::filesystem::path& path) {
  return read_frames(path, std::nullopt);
}

MammogramImage read_mammogram_slice(const std::filesystem::path& path, int slice) {
  return read_frames(path, slice);
}

MammogramImage read_mammogram(const std::filesystem::path& path) {
  return is_dicom(path) ? read_mammogram_dicom(path) : read_mammogram_picture(path);
}

}  // namespace mammotwin
