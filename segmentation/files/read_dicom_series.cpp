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

/// Area of a pixel times the distance between slices [mm^3]; large where it cannot be told.
double voxel_volume(const Series& series) {
  std::vector<double> along;
  const SlicePlacement& first = series.slices.front().placement;
  for (const DicomSlice& slice : series.slices)
    along.push_back(slice.placement.position.dot(first.normal()));
  std::sort(along.begin(), along.end());
  along.erase(std::unique(along.begin(), along.end(),
                          [](double a, double b) { return b - a < same_place_mm; }),
              along.end());
  if (along.size() < 2) return 1e9;
  const double step = (along.back() - along.front()) / static_cast<double>(along.size() - 1);
  return first.row_spacing * first.column_spacing * step;
}

/// Those whose voxels are no more than a tenth larger than the finest.
std::vector<Series> finest(std::vector<Series> all) {
  double least = 1e9;
  for (const Series& series : all) least = std::min(least, voxel_volume(series));
  std::erase_if(all, [&](const Series& series) { return voxel_volume(series) > 1.1 * least; });
  return all;
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

/// The stated rule where several series could serve: derived ones (subtractions, projections) are
/// left aside; where the rest holds a dynamic study, all others: a later, finer series is noisier
/// and its lesions have washed out. Then those with coarser voxels and with fewer slices; of what
/// is left the second in order of time is taken, the first after the contrast agent.
Series choose_by_rule(std::vector<Series> all, std::vector<std::string>& notes) {
  const std::size_t serving = all.size();
  if (!std::all_of(all.begin(), all.end(), is_derived)) std::erase_if(all, is_derived);
  const std::vector<Series> dynamic = dynamic_study(all);
  const std::size_t set_aside = dynamic.empty() ? 0 : all.size() - dynamic.size();
  if (!dynamic.empty()) all = dynamic;
  all = finest(std::move(all));
  std::size_t most = 0;
  for (const Series& series : all) most = std::max(most, series.slices.size());
  std::erase_if(all, [&](const Series& series) { return series.slices.size() < most; });
  std::stable_sort(all.begin(), all.end(), [](const Series& a, const Series& b) {
    return a.slices.front().acquisition_time < b.slices.front().acquisition_time;
  });
  const Series& chosen = all[all.size() > 1 ? 1 : 0];
  notes.push_back(
      "of " + std::to_string(serving) + " series was read: " + chosen.name() +
      (all.size() > 1
           ? ", the second in time of " + std::to_string(all.size()) +
                 " that are not derived and have the finest voxels and most slices (in a dynamic "
                 "study the first after the contrast agent)"
           : ", the one that is not derived and has the finest voxels and most slices") +
      (set_aside > 0
           ? "; " + std::to_string(set_aside) +
                 " of another geometry than the dynamic study's were left aside, finer or not"
           : "") +
      "; mri.series names another");
  return chosen;
}

void check_one_patient(const std::vector<Series>& all) {
  std::set<std::string> patients;
  for (const Series& series : all) patients.insert(series.slices.front().patient_id);
  if (patients.size() > 1)
    throw std::runtime_error("holds " + std::to_string(all.size()) + " MR series of " +
                             std::to_string(patients.size()) + " patients (by PatientID): " +
                             list(all) + "; expected one patient's, or name one with mri.series");
}

Series choose_series(std::vector<Series> all, const std::string& wanted,
                     std::vector<std::string>& notes) {
  std::vector<Series> matching;
  for (const Series& series : all)
    if (wanted.empty() ? series.slices.size() >= least_slices
                       : series.number == wanted || series.uid == wanted)
      matching.push_back(series);
  if (wanted.empty()) check_one_patient(matching);
  if (matching.size() > 1 && wanted.empty()) return choose_by_rule(std::move(matching), notes);
  if (matching.size() > 1)
    throw std::runtime_error("mri.series names " + std::to_string(matching.size()) + " series: " +
                             list(matching) + "; expected one (give its SeriesInstanceUID)");
  if (matching.empty() && !wanted.empty())
    throw std::runtime_error("mri.series names no series here; found " + list(all));
  if (matching.empty() && all.size() == 1) return all.front();
  if (matching.empty())
    throw std::runtime_error("holds no MR series of at least " + std::to_string(least_slices) +
                             " slices; found " + list(all));
  if (all.size() > 1) notes.push_back("of several series was read: " + matching.front().name());
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
    std::vector<Series> all = group_series(files, set_aside);
    if (all.empty())
      throw std::runtime_error("holds no MR image among " + std::to_string(files.size()) +
                               " file(s); expected DICOM (MR), or a NIfTI, NRRD or MHA file");
    if (set_aside > 0)
      out.notes.push_back(std::to_string(set_aside) +
                          " file(s) that are not MR images were left aside");
    Series chosen = choose_series(std::move(all), wanted, out.notes);
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
