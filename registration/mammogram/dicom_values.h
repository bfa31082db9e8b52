#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mammotwin {

/// Values of a tag, tidy: upper case without blanks at the ends; empty where it is missing.
std::string text_of(DcmItem& item, const DcmTagKey& tag);
std::vector<std::string> texts_of(DcmItem& item, const DcmTagKey& tag);

/// Of any representation: texts, binary integers of either sign, reals.
std::vector<double> numbers_of(DcmItem& item, const DcmTagKey& tag);
std::optional<double> number_of(DcmItem& item, const DcmTagKey& tag);
std::optional<int> count_of(DcmItem& item, const DcmTagKey& tag);

/// Throws std::runtime_error naming the file where it is no DICOM file.
DcmFileFormat load_dicom(const std::filesystem::path& path);

}  // namespace mammotwin
