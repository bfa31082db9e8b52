#include "registration/export/dicom/dicom_object.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>

namespace mammotwin::dicom {
namespace {

/// What an object shares with the image that it speaks of.
const DcmTagKey kShared[] = {DCM_PatientName,      DCM_PatientID,
                             DCM_PatientBirthDate, DCM_PatientSex,
                             DCM_StudyInstanceUID, DCM_StudyDate,
                             DCM_StudyTime,        DCM_StudyID,
                             DCM_AccessionNumber,  DCM_ReferringPhysicianName};

/// FNV-1a, 64 bits.
std::uint64_t hashed(const std::string& text, std::uint64_t start) {
  for (const unsigned char c : text) start = (start ^ c) * 1099511628211ull;
  return start;
}

}  // namespace

DcmFileFormat load(const std::filesystem::path& path) {
  DcmFileFormat file;
  if (const OFCondition status = file.loadFile(path.c_str()); status.bad())
    throw std::runtime_error(path.filename().string() +
                             ": not readable as DICOM: " + status.text());
  return file;
}

DcmFileFormat load_header(const std::filesystem::path& path) {
  DcmFileFormat file;
  if (const OFCondition status =
          file.loadFileUntilTag(path.c_str(), EXS_Unknown, EGL_noChange, DCM_MaxReadLength,
                                ERM_autoDetect, DCM_PixelData);
      status.bad())
    throw std::runtime_error(path.filename().string() +
                             ": not readable as DICOM: " + status.text());
  return file;
}

std::string text_of(DcmItem& item, const DcmTagKey& tag, const char* otherwise) {
  OFString value;
  if (item.findAndGetOFStringArray(tag, value).bad() || value.empty()) return otherwise;
  return value.c_str();
}

std::string derived_uid(const std::string& text) {
  unsigned __int128 number = hashed(text, 14695981039346656037ull) >> 2;
  number = (number << 64) | hashed(text + "#", 1469598103934665603ull);
  std::string digits;
  for (; number > 0; number /= 10)
    digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(number % 10)));
  return "2.25." + digits;
}

void put(DcmItem& item, const DcmTagKey& tag, const std::string& value) {
  if (const OFCondition status = item.putAndInsertString(tag, value.c_str()); status.bad())
    throw std::runtime_error("DICOM export: " + std::string(DcmTag(tag).getTagName()) + ": " +
                             status.text());
}

DcmItem& new_item(DcmItem& parent, const DcmTagKey& sequence) {
  DcmItem* item = nullptr;
  if (parent.findOrCreateSequenceItem(sequence, item, -2).bad() || !item)
    throw std::runtime_error("DICOM export: a sequence could not be made");
  return *item;
}

std::string number(double value) {
  char text[20];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

std::string in_ascii(const std::string& utf8) {
  std::string said;
  for (const unsigned char c : utf8) {
    const bool goes_on = (c & 0xc0) == 0x80;  // later bytes of a character
    if (!goes_on) said += c < ' ' || c > '~' || c == '\\' ? '?' : static_cast<char>(c);
  }
  return said;
}

Moment moment_of_making() {
  const char* given = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t now = given ? std::strtoll(given, nullptr, 10) : std::time(nullptr);
  std::tm parts{};
  given ? gmtime_r(&now, &parts) : localtime_r(&now, &parts);
  char date[16], time[16];
  std::strftime(date, sizeof date, "%Y%m%d", &parts);
  std::strftime(time, sizeof time, "%H%M%S", &parts);
  return {date, time};
}

void begin(DcmItem& source, const char* sop_class, const char* modality, const std::string& key,
           const Moment& made, DcmItem& object) {
  for (const DcmTagKey& tag : kShared) put(object, tag, text_of(source, tag));
  if (source.tagExistsWithValue(DCM_SpecificCharacterSet))
    put(object, DCM_SpecificCharacterSet, text_of(source, DCM_SpecificCharacterSet));
  const std::string seed =
      text_of(source, DCM_SOPInstanceUID) + modality + key + made.date + made.time;
  put(object, DCM_InstanceCreationDate, made.date);
  put(object, DCM_InstanceCreationTime, made.time);
  put(object, DCM_SeriesDate, made.date);
  put(object, DCM_SeriesTime, made.time);
  put(object, DCM_SOPClassUID, sop_class);
  put(object, DCM_SOPInstanceUID, derived_uid(seed));
  put(object, DCM_SeriesInstanceUID, derived_uid(seed + "series"));
  put(object, DCM_SeriesNumber, "9000");
  put(object, DCM_InstanceNumber, "1");
  put(object, DCM_Modality, modality);
  put(object, DCM_Manufacturer, kMaker);
  put(object, DCM_ManufacturerModelName, kMaker);
  put(object, DCM_DeviceSerialNumber, "0");
  put(object, DCM_SoftwareVersions, "1");
}

void save(DcmFileFormat& file, const std::filesystem::path& path) {
  if (const OFCondition status = file.saveFile(path.c_str(), EXS_LittleEndianExplicit);
      status.bad())
    throw std::runtime_error(path.string() + ": cannot be written: " + status.text());
}

void check(const OFCondition& status, const char* what) {
  if (status.bad())
    throw std::runtime_error(std::string("DICOM export: ") + what + ": " + status.text());
}

}  // namespace mammotwin::dicom
