#include "segmentation/files/read_dicom_series.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "segmentation/files/dicom_slice.h"
#include "segmentation/files/trial_read.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t least_slices = 16;  // fewer is a localiser, not a breast

bool is_short_number(const std::string& text) {
  constexpr std::size_t most_digits = 6;  // longer ones are identifiers
  return !text.empty() && text.size() <= most_digits &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

struct Series {
  std::string uid, number;
  std::vector<DicomSlice> slices;

  /// What tells it apart and names nobody: descriptions and file names may hold anything.
  std::string name() const {
    return "series " + (is_short_number(number) ? number : "without number") + " (" +
           std::to_string(slices.size()) + " slices)";
  }
};

/// Order of whole numbers written as text.
bool before(const std::string& a, const std::string& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

std::vector<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw std::runtime_error("the folder is empty; expected the DICOM files of one MRI series");
  return files;
}

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

std::vector<Series> group_series(const std::vector<fs::path>& files, std::size_t& set_aside) {
  std::map<std::string, Series> by_uid;
  set_aside = 0;
  for (const fs::path& file : files) {
    const std::vector<DicomSlice> slices = read_dicom_slices(file);
    if (slices.empty() || slices.front().modality != "MR") {
      ++set_aside;
      continue;
    }
    Series& series = by_uid[slices.front().series_uid];
    series.uid = slices.front().series_uid;
    series.number = slices.front().series_number;
    series.slices.insert(series.slices.end(), slices.begin(), slices.end());
  }
  std::vector<Series> all;
  for (auto& [uid, series] : by_uid) all.push_back(std::move(series));
  std::stable_sort(all.begin(), all.end(),
                   [](const Series& a, const Series& b) { return before(a.number, b.number); });
  return all;
}

std::string list(const std::vector<Series>& all) {
  std::string text;
  for (const Series& series : all) text += (text.empty() ? "" : "; ") + series.name();
  return text;
}

/// Computed from other images: told by the first value of ImageType, or by a later one, as scanners
/// call what they compute "original", too.
bool is_derived(const Series& series) {
  static const std::set<std::string> computed{
      "DERIVED", "SUB", "WI", "WO", "PEI", "MIP", "MPR", "ADC", "TRACEW", "PROJECTION IMAGE"};
  std::istringstream values(series.slices.front().image_type);
  for (std::string value; std::getline(values, value, '\\');)
    if (computed.count(value) || value.rfind("MIP_", 0) == 0) return true;
  return false;
}

double seconds_of(const std::string& time) {
  constexpr std::size_t whole = 6;  // HHMMSS
  if (time.size() < whole || time.find_first_not_of("0123456789.") != std::string::npos) return 0;
  return 3600 * std::stod(time.substr(0, 2)) + 60 * std::stod(time.substr(2, 2)) +
         std::stod(time.substr(4));
}

/// Sorted places of the slices along their normal, each once.
std::vector<double> places_along(const Series& series) {
  std::vector<double> along;
  const Eigen::Vector3d normal = series.slices.front().placement.normal();
  for (const DicomSlice& slice : series.slices)
    along.push_back(slice.placement.position.dot(normal));
  std::sort(along.begin(), along.end());
  along.erase(std::unique(along.begin(), along.end(),
                          [](double a, double b) { return b - a < same_place_mm; }),
              along.end());
  return along;
}

/// The same place imaged in the same way.
bool same_geometry(const Series& a, const Series& b) {
  const SlicePlacement &p = a.slices.front().placement, &q = b.slices.front().placement;
  return a.slices.size() == b.slices.size() && p.columns == q.columns && p.rows == q.rows &&
         std::abs(p.row_spacing - q.row_spacing) < same_place_mm;
}

/// The series that repeat one geometry three times or more, the longest such run: a dynamic study.
/// Empty without one.
std::vector<Series> dynamic_study(const std::vector<Series>& all) {
  constexpr std::size_t least_phases = 3;
  std::vector<Series> longest;
  for (const Series& first : all) {
    std::vector<Series> run;
    std::copy_if(all.begin(), all.end(), std::back_inserter(run),
                 [&](const Series& other) { return same_geometry(first, other); });
    if (run.size() >= least_phases && run.size() > longest.size()) longest = std::move(run);
  }
  return longest;
}

GridImage load(const Series& series) {
  std::vector<SlicePlacement> placements;
  for (const DicomSlice& slice : series.slices) placements.push_back(slice.placement);
  const SliceStack stack = stack_slices(placements);
  const SlicePlacement& first = placements[stack.order.front()];
  if (!(first.row_spacing > 0 && first.column_spacing > 0))
    throw std::runtime_error("PixelSpacing is missing or not positive; expected two numbers in mm");

  GridImage image;
  image.size = {first.columns, first.rows, static_cast<int>(stack.order.size())};
  image.spacing = {first.column_spacing, first.row_spacing, stack.spacing};
  image.origin = first.position;
  image.direction << first.along_row, first.along_column, first.normal();
  const std::size_t slice_size = static_cast<std::size_t>(first.columns) * first.rows;
  image.values.resize(slice_size * stack.order.size());
  fs::path loaded;
  std::vector<float> pixels;
  for (std::size_t n = 0; n < stack.order.size(); ++n) {
    const DicomSlice& slice = series.slices[stack.order[n]];
    if (slice.file != loaded) pixels = read_dicom_pixels(loaded = slice.file);
    if (pixels.size() < slice_size * (slice.frame + 1))
      throw std::runtime_error(slice.placement.name + ": has fewer pixels than its header says");
    std::copy_n(pixels.begin() + slice_size * slice.frame, slice_size,
                image.values.begin() + slice_size * n);
  }
  return image;
}

/// The middle of a series, as much as tells how it looks; empty where it makes no stack.
std::optional<SeriesLook> look_at(Series series) {
  constexpr std::size_t enough = 40;  // slices
  const Eigen::Vector3d normal = series.slices.front().placement.normal();
  std::stable_sort(series.slices.begin(), series.slices.end(),
                   [&](const DicomSlice& a, const DicomSlice& b) {
                     return a.placement.position.dot(normal) < b.placement.position.dot(normal);
                   });
  if (series.slices.size() > enough) {
    const auto first = static_cast<std::ptrdiff_t>((series.slices.size() - enough) / 2);
    series.slices = {series.slices.begin() + first,
                     series.slices.begin() + first + static_cast<std::ptrdiff_t>(enough)};
  }
  try {
    std::vector<std::string> notes;
    return look_at_series(to_lps_grid(load(series), Between::linear, notes));
  } catch (const std::exception&) {
    return std::nullopt;  // whoever names it is told why
  }
}

SeriesRow row_of(const Series& series, double first_seconds) {
  const std::vector<double> along = places_along(series);
  const SlicePlacement& place = series.slices.front().placement;
  SeriesRow row;
  row.number = is_short_number(series.number) ? series.number : "";
  row.slices = series.slices.size();
  row.covers_mm = along.back() - along.front();
  const double step =
      along.size() > 1 ? row.covers_mm / static_cast<double>(along.size() - 1) : 1e3;
  row.voxel_mm = {place.column_spacing, place.row_spacing, step};
  row.is_computed = is_derived(series);
  row.seconds = seconds_of(series.slices.front().acquisition_time) - first_seconds;
  return row;
}

/// Numbers the phases of the dynamic study in order of time.
void number_phases(const std::vector<Series>& all, std::vector<SeriesRow>& rows) {
  std::vector<Series> originals = all;
  std::erase_if(originals, is_derived);
  std::vector<Series> dynamic = dynamic_study(originals);
  std::stable_sort(dynamic.begin(), dynamic.end(), [](const Series& a, const Series& b) {
    return a.slices.front().acquisition_time < b.slices.front().acquisition_time;
  });
  for (std::size_t p = 0; p < dynamic.size(); ++p)
    for (std::size_t n = 0; n < all.size(); ++n)
      if (all[n].uid == dynamic[p].uid) rows[n].phase = static_cast<int>(p) + 1;
}

std::vector<SeriesRow> table_of(const std::vector<Series>& all) {
  constexpr int looked_at_phases = 2;  // the others look alike
  double first = seconds_of(all.front().slices.front().acquisition_time);
  for (const Series& series : all)
    first = std::min(first, seconds_of(series.slices.front().acquisition_time));
  std::vector<SeriesRow> rows;
  for (const Series& series : all) rows.push_back(row_of(series, first));
  number_phases(all, rows);
  for (std::size_t n = 0; n < all.size(); ++n)
    if (!rows[n].is_computed && rows[n].phase <= looked_at_phases) rows[n].look = look_at(all[n]);
  return rows;
}

/// Where several series could serve: choose_series_row.
Series choose_by_rule(const std::vector<Series>& all, DicomVolume& out) {
  out.series = table_of(all);
  const std::size_t chosen = choose_series_row(out.series);
  out.notes.push_back("of " + std::to_string(all.size()) +
                      " series was read: " + all[chosen].name() + ", " + out.series[chosen].reason +
                      "; mri.series names another");
  return all[chosen];
}

void check_one_patient(const std::vector<Series>& all) {
  std::set<std::string> patients;
  for (const Series& series : all) patients.insert(series.slices.front().patient_id);
  if (patients.size() > 1)
    throw std::runtime_error("holds " + std::to_string(all.size()) + " MR series of " +
                             std::to_string(patients.size()) + " patients (by PatientID): " +
                             list(all) + "; expected one patient's, or name one with mri.series");
}

Series choose_series(const std::vector<Series>& all, const std::string& wanted, DicomVolume& out) {
  std::vector<Series> matching;
  for (const Series& series : all)
    if (wanted.empty() ? series.slices.size() >= least_slices
                       : series.number == wanted || series.uid == wanted)
      matching.push_back(series);
  if (wanted.empty()) check_one_patient(matching);
  if (matching.size() > 1 && wanted.empty()) return choose_by_rule(matching, out);
  if (matching.size() > 1)
    throw std::runtime_error("mri.series names " + std::to_string(matching.size()) + " series: " +
                             list(matching) + "; expected one (give its SeriesInstanceUID)");
  if (matching.empty() && !wanted.empty())
    throw std::runtime_error("mri.series names no series here; found " + list(all));
  if (matching.empty() && all.size() == 1) return all.front();
  if (matching.empty())
    throw std::runtime_error("holds no MR series of at least " + std::to_string(least_slices) +
                             " slices; found " + list(all));
  if (all.size() > 1) out.notes.push_back("of several series was read: " + matching.front().name());
  return matching.front();
}

/// One patient's identifier in every slice: an archive that is wrongly sorted mixes two.
void check_slices_of_one_patient(const Series& series) {
  std::set<std::string> patients;
  for (const DicomSlice& slice : series.slices) patients.insert(slice.patient_id);
  if (patients.size() > 1)
    throw std::runtime_error(series.name() + " holds slices of " + std::to_string(patients.size()) +
                             " patients (by PatientID); expected one patient's (take the others "
                             "out, or export the series again)");
}

/// Leaves the slices of one phase in the series.
void choose_phase(Series& series, const std::string& wanted, std::vector<std::string>& notes) {
  std::vector<SlicePlacement> placements;
  for (const DicomSlice& slice : series.slices) placements.push_back(slice.placement);
  if (wanted.empty() && !has_repeated_positions(placements)) return;
  std::map<std::string, std::size_t> counts;
  for (const DicomSlice& slice : series.slices) ++counts[slice.phase];
  if (wanted.empty() && counts.size() == 1) return;  // repeated slices: the stack will say so
  std::vector<std::string> phases;
  for (const auto& [phase, count] : counts) phases.push_back(phase);
  std::stable_sort(phases.begin(), phases.end(),
                   [](const auto& a, const auto& b) { return before(a, b); });
  const std::string phase = wanted.empty() ? phases[1] : wanted;
  if (!counts.count(phase))
    throw std::runtime_error("mri.series names phase " + phase + ", but the series has " +
                             phases.front() + " to " + phases.back());
  std::erase_if(series.slices, [&](const DicomSlice& slice) { return slice.phase != phase; });
  notes.push_back("the series holds " + std::to_string(phases.size()) + " phases; phase " + phase +
                  " was read" +
                  (wanted.empty() ? " (the second: in a dynamic series the first after the "
                                    "contrast agent; mri.series = \"NUMBER:PHASE\" names another)"
                                  : ""));
}

}  // namespace

DicomVolume read_dicom_series(const fs::path& path, const std::optional<std::string>& series) {
  DicomVolume out;
  std::string wanted = series.value_or(""), wanted_phase;
  if (const auto colon = wanted.find(':'); colon != std::string::npos) {
    wanted_phase = wanted.substr(colon + 1);
    wanted.resize(colon);
  }
  try {
    const std::vector<fs::path> files = files_of(path);
    check_survivable(files);
    std::size_t set_aside = 0;
    const std::vector<Series> all = group_series(files, set_aside);
    if (all.empty())
      throw std::runtime_error("holds no MR image among " + std::to_string(files.size()) +
                               " file(s); expected DICOM (MR), or a NIfTI, NRRD or MHA file");
    if (set_aside > 0)
      out.notes.push_back(std::to_string(set_aside) +
                          " file(s) that are not MR images were left aside");
    Series chosen = choose_series(all, wanted, out);
    check_slices_of_one_patient(chosen);
    choose_phase(chosen, wanted_phase, out.notes);
    out.geometry_known = chosen.slices.front().geometry_known;
    out.patient_position = chosen.slices.front().patient_position;
    out.image = load(chosen);
    for (const DicomSlice& slice : chosen.slices)
      if (out.files.empty() || out.files.back() != slice.file) out.files.push_back(slice.file);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return out;
}

}  // namespace mammotwin
