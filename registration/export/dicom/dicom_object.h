#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <filesystem>
#include <string>

namespace mammotwin::dicom {

inline constexpr const char* kMaker = "Mammotwin";

/// Throws std::runtime_error naming the file.
DcmFileFormat load(const std::filesystem::path& path);
/// The same without pixels.
DcmFileFormat load_header(const std::filesystem::path& path);
void save(DcmFileFormat& file, const std::filesystem::path& path);

std::string text_of(DcmItem& item, const DcmTagKey& tag, const char* otherwise = "");
void put(DcmItem& item, const DcmTagKey& tag, const std::string& value);
/// A lesion's name as every character set of DICOM can say it: what is not ASCII becomes "?".
std::string in_ascii(const std::string& utf8);
DcmItem& new_item(DcmItem& parent, const DcmTagKey& sequence);

/// "2.25." and a number of 126 bits (PS3.5 B.2) that `text` gives.
std::string derived_uid(const std::string& text);

/// A decimal string of three decimals.
std::string number(double value);

/// Date and time of an object's making, as DICOM writes them: those of the clock, or of
/// SOURCE_DATE_EPOCH (reproducible-builds.org), then in UTC.
struct Moment {
  std::string date, time;
};
Moment moment_of_making();

/// Patient, study, equipment and the object's own identity: another at each making, as an archive
/// keeps the first object of a name.
void begin(DcmItem& source, const char* sop_class, const char* modality, const std::string& key,
           const Moment& made, DcmItem& object);

/// Throws std::runtime_error with `what` where `status` is bad.
void check(const OFCondition& status, const char* what);

}  // namespace mammotwin::dicom
