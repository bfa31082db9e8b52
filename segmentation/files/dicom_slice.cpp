#include "segmentation/files/dicom_slice.h"

#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "segmentation/files/dicom_pixel_length.h"

namespace mammotwin {
namespace {

using gdcm::DataSet;
using gdcm::Tag;

const Tag modality_tag(0x0008, 0x0060), series_uid_tag(0x0020, 0x000e),
    patient_id_tag(0x0010, 0x0020), series_number_tag(0x0020, 0x0011), position_tag(0x0020, 0x0032),
    orientation_tag(0x0020, 0x0037), spacing_tag(0x0028, 0x0030), rows_tag(0x0028, 0x0010),
    columns_tag(0x0028, 0x0011), frames_tag(0x0028, 0x0008), temporal_position_tag(0x0020, 0x0100),
    acquisition_tag(0x0020, 0x0012), echo_tag(0x0018, 0x0086), slice_distance_tag(0x0018, 0x0088),
    per_frame_tag(0x5200, 0x9230), shared_tag(0x5200, 0x9229), plane_position_tag(0x0020, 0x9113),
    plane_orientation_tag(0x0020, 0x9116), pixel_measures_tag(0x0028, 0x9110),
    frame_content_tag(0x0020, 0x9111), temporal_index_tag(0x0020, 0x9128),
    patient_position_tag(0x0018, 0x5100), image_type_tag(0x0008, 0x0008),
    acquisition_time_tag(0x0008, 0x0032), pixels_tag(0x7fe0, 0x0010);

constexpr double most_frames = 10000;  // more is a damaged header

std::string text(const DataSet& set, const Tag& tag) {
  if (!set.FindDataElement(tag)) return {};
  const gdcm::ByteValue* value = set.GetDataElement(tag).GetByteValue();
  if (!value) return {};
  std::string s(value->GetPointer(), value->GetLength());
  while (!s.empty() && (s.back() == ' ' || s.back() == '\0')) s.pop_back();
  return s;
}

/// Numbers of a decimal string, as many as it holds.
std::vector<double> numbers(const DataSet& set, const Tag& tag) {
  std::vector<double> out;
  std::stringstream stream(text(set, tag));
  for (std::string part; std::getline(stream, part, '\\');) {
    try {
      out.push_back(std::stod(part));
    } catch (const std::exception&) {
      return {};
    }
  }
  return out;
}

int unsigned_short(const DataSet& set, const Tag& tag) {
  const std::string bytes = [&] {
    if (!set.FindDataElement(tag)) return std::string();
    const gdcm::ByteValue* value = set.GetDataElement(tag).GetByteValue();
    return value ? std::string(value->GetPointer(), value->GetLength()) : std::string();
  }();
  if (bytes.size() < 2) return 0;
  std::uint16_t number;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

/// One of DICOM's codes for how the patient lies; nothing else leaves the header.
std::string known_position(const std::string& code) {
  for (const char* known : {"HFP", "HFS", "HFDR", "HFDL", "FFP", "FFS", "FFDR", "FFDL"})
    if (code == known) return code;
  return {};
}

/// First item of a sequence inside an item; null where there is none.
gdcm::SmartPointer<gdcm::SequenceOfItems> sequence(const DataSet& set, const Tag& tag) {
  if (!set.FindDataElement(tag)) return nullptr;
  gdcm::SmartPointer<gdcm::SequenceOfItems> items = set.GetDataElement(tag).GetValueAsSQ();
  if (!items || items->GetNumberOfItems() == 0) return nullptr;
  return items;
}

/// Sets position, orientation and pixel spacing from the elements of `set` that exist.
void read_plane(const DataSet& set, SlicePlacement& placement, bool& placed) {
  if (const auto p = numbers(set, position_tag); p.size() == 3) {
    placement.position = Eigen::Vector3d(p[0], p[1], p[2]);
    placed = true;
  }
  if (const auto o = numbers(set, orientation_tag); o.size() == 6) {
    placement.along_row = Eigen::Vector3d(o[0], o[1], o[2]).normalized();
    placement.along_column = Eigen::Vector3d(o[3], o[4], o[5]).normalized();
  }
  if (const auto s = numbers(set, spacing_tag); s.size() == 2) {
    placement.row_spacing = s[0];
    placement.column_spacing = s[1];
  }
}

/// The same from the functional groups of an enhanced object.
void read_groups(const DataSet& groups, SlicePlacement& placement, bool& placed) {
  for (const Tag& tag : {plane_position_tag, plane_orientation_tag, pixel_measures_tag})
    if (const auto items = sequence(groups, tag))
      read_plane(items->GetItem(1).GetNestedDataSet(), placement, placed);
}

std::string first_nonempty(std::initializer_list<std::string> candidates) {
  for (const std::string& candidate : candidates)
    if (!candidate.empty()) return candidate;
  return {};
}

std::vector<DicomSlice> read_enhanced_frames(const DataSet& set, const DicomSlice& common,
                                             bool placed) {
  std::vector<DicomSlice> slices;
  DicomSlice shared = common;
  if (const auto items = sequence(set, shared_tag))
    read_groups(items->GetItem(1).GetNestedDataSet(), shared.placement, placed);
  const auto frames = sequence(set, per_frame_tag);
  for (std::size_t n = 1; n <= frames->GetNumberOfItems(); ++n) {
    const DataSet& groups = frames->GetItem(n).GetNestedDataSet();
    DicomSlice slice = shared;
    bool frame_placed = placed;
    read_groups(groups, slice.placement, frame_placed);
    slice.frame = static_cast<int>(n) - 1;
    slice.placement.name += " frame " + std::to_string(n);
    if (const auto content = sequence(groups, frame_content_tag)) {
      const DataSet& nested = content->GetItem(1).GetNestedDataSet();
      if (nested.FindDataElement(temporal_index_tag))
        slice.phase = std::to_string(unsigned_short(nested, temporal_index_tag));
    }
    if (frame_placed) slices.push_back(slice);
  }
  return slices;
}

/// Frames of an object that gives them no place: axial, 1 mm pixels, and said to be unknown.
std::vector<DicomSlice> frames_without_place(const DataSet& set, DicomSlice slice, int frames) {
  slice.geometry_known = false;
  slice.placement.along_row = Eigen::Vector3d::UnitX();
  slice.placement.along_column = Eigen::Vector3d::UnitY();
  if (!(slice.placement.row_spacing > 0))
    slice.placement.row_spacing = slice.placement.column_spacing = 1;
  const std::vector<double> distance = numbers(set, slice_distance_tag);
  const double step = distance.size() == 1 && distance[0] > 0 ? distance[0] : 1;
  const std::string file_name = slice.placement.name;
  std::vector<DicomSlice> slices;
  for (int n = 0; n < frames; ++n) {
    slice.frame = n;
    slice.placement.name = file_name + " frame " + std::to_string(n + 1);
    slice.placement.position = {0, 0, n * step};
    slices.push_back(slice);
  }
  return slices;
}

}  // namespace

std::vector<DicomSlice> read_dicom_slices(const std::filesystem::path& file) {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  if (!reader.ReadUpToTag(pixels_tag)) return {};
  const DataSet& set = reader.GetFile().GetDataSet();

  DicomSlice slice;
  slice.file = file;
  slice.placement.name = file.filename().string();
  slice.placement.rows = unsigned_short(set, rows_tag);
  slice.placement.columns = unsigned_short(set, columns_tag);
  if (slice.placement.rows == 0 || slice.placement.columns == 0) return {};
  slice.modality = text(set, modality_tag);
  slice.series_uid = text(set, series_uid_tag);
  slice.patient_id = text(set, patient_id_tag);
  slice.series_number = text(set, series_number_tag);
  slice.image_type = text(set, image_type_tag);
  slice.acquisition_time = text(set, acquisition_time_tag);
  slice.patient_position = known_position(text(set, patient_position_tag));
  slice.phase = first_nonempty(
      {text(set, temporal_position_tag), text(set, acquisition_tag), text(set, echo_tag)});
  slice.placement.along_row = slice.placement.along_column = Eigen::Vector3d::Zero();
  bool placed = false;
  read_plane(set, slice.placement, placed);
  if (sequence(set, per_frame_tag)) return read_enhanced_frames(set, slice, placed);
  if (const auto frames = numbers(set, frames_tag); frames.size() == 1 && frames[0] > 1)
    return frames_without_place(set, slice, static_cast<int>(std::min(frames[0], most_frames)));
  if (!placed) return {};  // a secondary capture or report image: it stands nowhere in the patient
  return {slice};
}

namespace {

template <class T>
std::vector<float> scaled(const std::vector<char>& bytes, double slope, double intercept) {
  std::vector<float> values(bytes.size() / sizeof(T));
  for (std::size_t n = 0; n < values.size(); ++n) {
    T value;
    std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
    values[n] = static_cast<float>(slope * value + intercept);
  }
  return values;
}

}  // namespace

std::vector<float> read_dicom_pixels(const std::filesystem::path& file) {
  gdcm::ImageReader reader;
  reader.SetFileName(file.c_str());
  const auto fail = [&](const std::string& what) -> std::vector<float> {
    throw std::runtime_error(file.filename().string() + ": " + what);
  };
  if (!reader.Read())
    return fail("pixels cannot be read; expected a complete DICOM image (export it again)");
  const gdcm::Image& image = reader.GetImage();
  if (image.GetPixelFormat().GetSamplesPerPixel() != 1)
    return fail("holds colour pixels; expected one grey value a pixel (is it a screen capture?)");
  std::size_t expected = image.GetPixelFormat().GetPixelSize();
  for (unsigned d = 0; d < image.GetNumberOfDimensions(); ++d) expected *= image.GetDimension(d);
  if (image.GetBufferLength() != expected)
    return fail("its pixels take " + std::to_string(image.GetBufferLength()) + " bytes; expected " +
                std::to_string(expected) + " (export it again)");
  try {
    if (image.GetPixelFormat().GetBitsAllocated() % 8 == 0) check_pixels_whole(file, expected);
  } catch (const std::runtime_error& error) {
    return fail(error.what());
  }
  std::vector<char> bytes(expected);
  if (!image.GetBuffer(bytes.data()))
    return fail("pixels cannot be decoded; expected a complete DICOM image (export it again)");
  const double slope = image.GetSlope(), intercept = image.GetIntercept();
  switch (image.GetPixelFormat().GetScalarType()) {
    case gdcm::PixelFormat::UINT8:
      return scaled<std::uint8_t>(bytes, slope, intercept);
    case gdcm::PixelFormat::INT8:
      return scaled<std::int8_t>(bytes, slope, intercept);
    case gdcm::PixelFormat::UINT12:
    case gdcm::PixelFormat::UINT16:
      return scaled<std::uint16_t>(bytes, slope, intercept);
    case gdcm::PixelFormat::INT12:
    case gdcm::PixelFormat::INT16:
      return scaled<std::int16_t>(bytes, slope, intercept);
    case gdcm::PixelFormat::UINT32:
      return scaled<std::uint32_t>(bytes, slope, intercept);
    case gdcm::PixelFormat::INT32:
      return scaled<std::int32_t>(bytes, slope, intercept);
    case gdcm::PixelFormat::FLOAT32:
      return scaled<float>(bytes, slope, intercept);
    case gdcm::PixelFormat::FLOAT64:
      return scaled<double>(bytes, slope, intercept);
    default:
      return fail("has an unknown pixel format; expected 8 to 32 bit grey values");
  }
}

}  // namespace mammotwin
