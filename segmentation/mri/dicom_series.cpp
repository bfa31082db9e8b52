#include "segmentation/mri/dicom_series.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "segmentation/files/trial_read.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// Throws where the DICOM library would end the program over one of the files, or never end.
void check_survivable(const std::vector<fs::path>& files) {
  const auto failed = first_fatal(Trial::dicom, files);
  if (!failed) return;
  throw std::runtime_error(
      files[failed->file].filename().string() +
      (failed->timed_out
           ? ": could not be read within a minute; expected a complete DICOM file (is it damaged, "
             "or does its disk not answer?)"
           : ": is damaged, the DICOM library cannot go through it; expected a complete DICOM file "
             "(copy or export it again)"));
}

}  // namespace

std::string DicomSeries::short_number() const {
  constexpr std::size_t most_digits = 6;
  return number.size() <= most_digits && number.find_first_not_of("0123456789") == std::string::npos
             ? number
             : "";
}

std::string DicomSeries::name() const {
  const std::string known = short_number();
  return "series " + (known.empty() ? "without number" : known) + " (" +
         std::to_string(slices.size()) + " slices)";
}

std::string names_of(const std::vector<DicomSeries>& all) {
  std::string text;
  for (const DicomSeries& series : all) text += (text.empty() ? "" : "; ") + series.name();
  return text;
}

bool number_before(const std::string& a, const std::string& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

std::vector<DicomSeries> group_series(const std::vector<fs::path>& files, std::size_t& set_aside) {
  check_survivable(files);
  std::map<std::string, DicomSeries> by_uid;
  set_aside = 0;
  for (const fs::path& file : files) {
    const std::vector<DicomSlice> slices = read_dicom_slices(file);
    if (slices.empty() || slices.front().modality != "MR") {
      ++set_aside;
      continue;
    }
    DicomSeries& series = by_uid[slices.front().series_uid];
    series.uid = slices.front().series_uid;
    series.number = slices.front().series_number;
    series.slices.insert(series.slices.end(), slices.begin(), slices.end());
  }
  std::vector<DicomSeries> all;
  for (auto& [uid, series] : by_uid) all.push_back(std::move(series));
  std::stable_sort(all.begin(), all.end(), [](const DicomSeries& a, const DicomSeries& b) {
    return number_before(a.number, b.number);
  });
  return all;
}

}  // namespace mammotwin
