#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// What a test says in a DICOM header (explicit VR, little endian, written by hand).
struct DicomHeader {
  std::string series_uid = "1.2.3", series_number = "1", description = "t1", modality = "MR";
  std::string patient_position = "HFP";
  std::string image_type = "ORIGINAL\\PRIMARY";
  std::string acquisition_time;   ///< "120000"
  std::string temporal_position;  ///< phase of a dynamic series
  std::string contrast_agent;
  std::string patient_id;  ///< where `identified` says none
  bool identified =
      false;  ///< names, dates and identifiers besides the patient's name, as planted_identity says
};

/// What an identified header says of the patient and nothing else does: to be searched for.
inline std::vector<std::string> planted_identity() {
  return {"SECRET",          "PLANTED-ACCESSION", "PLANTED HOSPITAL", "PHYSICIAN^PLANTED",
          "PLANTED-ID-4711", "19510203",          "20010405",         "1.2.840.99.77.1.4711",
          "PLANTED-STUDY"};
}

/// One slice of 16-bit pixels as a DICOM file's bytes.
inline std::string dicom_slice_bytes(const DicomHeader& header, int number, int columns, int rows,
                                     const std::array<double, 3>& position, double pixel_mm,
                                     const std::vector<std::uint16_t>& pixels) {
  std::string out(128, '\0');
  out += "DICM";
  const auto number16 = [](std::uint16_t v) { return std::string{char(v & 255), char(v >> 8)}; };
  const auto element = [&](std::uint16_t group, std::uint16_t tag, const char* vr,
                           std::string value) {
    if (value.size() % 2) value += std::strcmp(vr, "UI") == 0 ? '\0' : ' ';
    out += number16(group) + number16(tag) + vr;
    const auto size = static_cast<std::uint32_t>(value.size());
    if (std::strcmp(vr, "OW") == 0)
      out += std::string(2, '\0') + number16(size & 65535) + number16(size >> 16);
    else
      out += number16(static_cast<std::uint16_t>(size));
    out += value;
  };
  const auto decimals = [](std::initializer_list<double> values) {
    std::ostringstream text;
    for (const double v : values) text << (text.tellp() > 0 ? "\\" : "") << v;
    return text.str();
  };
  const std::string syntax = "1.2.840.10008.1.2.1", mr = "1.2.840.10008.5.1.4.1.1.4";
  const std::string uid = header.series_uid + "." + std::to_string(number + 1);
  element(2, 0x0010, "UI", syntax);
  element(8, 0x0008, "CS", header.image_type);
  element(8, 0x0016, "UI", mr);
  element(8, 0x0018, "UI", uid);
  if (header.identified) element(8, 0x0020, "DA", "20010405");
  if (!header.acquisition_time.empty()) element(8, 0x0032, "TM", header.acquisition_time);
  if (header.identified) element(8, 0x0050, "SH", "PLANTED-ACCESSION");
  element(8, 0x0060, "CS", header.modality);
  if (header.identified) {
    element(8, 0x0080, "LO", "PLANTED HOSPITAL");
    element(8, 0x0090, "PN", "PHYSICIAN^PLANTED");
  }
  element(8, 0x103e, "LO", header.description);
  element(0x10, 0x0010, "PN", "SECRET^NAME");
  if (header.identified) {
    element(0x10, 0x0020, "LO", "PLANTED-ID-4711");
    element(0x10, 0x0030, "DA", "19510203");
  }
  if (!header.identified && !header.patient_id.empty())
    element(0x10, 0x0020, "LO", header.patient_id);
  if (!header.contrast_agent.empty()) element(0x18, 0x0010, "LO", header.contrast_agent);
  element(0x18, 0x5100, "CS", header.patient_position);
  if (header.identified) element(0x20, 0x000d, "UI", "1.2.840.99.77.1.4711");
  element(0x20, 0x000e, "UI", header.series_uid);
  if (header.identified) element(0x20, 0x0010, "SH", "PLANTED-STUDY");
  element(0x20, 0x0011, "IS", header.series_number);
  element(0x20, 0x0032, "DS", decimals({position[0], position[1], position[2]}));
  element(0x20, 0x0037, "DS", "1\\0\\0\\0\\1\\0");
  if (!header.temporal_position.empty()) element(0x20, 0x0100, "IS", header.temporal_position);
  element(0x28, 0x0002, "US", number16(1));
  element(0x28, 0x0004, "CS", "MONOCHROME2");
  element(0x28, 0x0010, "US", number16(static_cast<std::uint16_t>(rows)));
  element(0x28, 0x0011, "US", number16(static_cast<std::uint16_t>(columns)));
  element(0x28, 0x0030, "DS", decimals({pixel_mm, pixel_mm}));
  element(0x28, 0x0100, "US", number16(16));
  element(0x28, 0x0101, "US", number16(16));
  element(0x28, 0x0102, "US", number16(15));
  element(0x28, 0x0103, "US", number16(0));
  element(0x7fe0, 0x0010, "OW",
          std::string(reinterpret_cast<const char*>(pixels.data()), 2 * pixels.size()));
  return out;
}

/// A volume as one file a slice: prefix0000.dcm, ...
inline void write_dicom_series(const std::filesystem::path& folder, const std::string& prefix,
                               const DicomHeader& header, const Volume<float>& image) {
  std::filesystem::create_directories(folder);
  for (int k = 0; k < image.size.z(); ++k) {
    std::vector<std::uint16_t> pixels;
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        pixels.push_back(static_cast<std::uint16_t>(image(i, j, k)));
    const Eigen::Vector3d x = image.position(0, 0, k);
    const std::string name = std::to_string(10000 + k).substr(1);
    std::ofstream(folder / (prefix + name + ".dcm"), std::ios::binary)
        << dicom_slice_bytes(header, k, image.size.x(), image.size.y(), {x.x(), x.y(), x.z()},
                             image.spacing.x(), pixels);
  }
}

}  // namespace mammotwin
