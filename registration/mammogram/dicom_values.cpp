#include "registration/mammogram/dicom_values.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
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

}  // namespace

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

DcmFileFormat load_dicom(const std::filesystem::path& path) {
  DcmFileFormat file;
  const OFCondition status = file.loadFile(path.c_str());
  if (status.bad())
    throw std::runtime_error(path.filename().string() +
                             ": not readable as DICOM: " + status.text());
  return file;
}

}  // namespace mammotwin
