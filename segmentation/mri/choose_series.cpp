#include "segmentation/mri/choose_series.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "segmentation/mri/series_table.h"

namespace mammotwin {
namespace {

void check_one_patient(const std::vector<DicomSeries>& all) {
  std::set<std::string> patients;
  for (const DicomSeries& series : all) patients.insert(series.slices.front().patient_id);
  if (patients.size() > 1)
    throw std::runtime_error("holds " + std::to_string(all.size()) + " MR series of " +
                             std::to_string(patients.size()) +
                             " patients (by PatientID): " + names_of(all) +
                             "; expected one patient's, or name one with mri.series");
}

/// Where several series could serve.
ChosenSeries choose_by_rule(const std::vector<DicomSeries>& all) {
  ChosenSeries out;
  out.weighed = series_table(all);
  const std::size_t chosen = choose_series_row(out.weighed);
  out.series = all[chosen];
  choose_compared_row(out.weighed, chosen);
  out.notes = {"of " + std::to_string(all.size()) + " series was read: " + out.series.name() +
               ", " + out.weighed[chosen].reason + "; mri.series names another"};
  return out;
}

ChosenSeries choose_named(const std::vector<DicomSeries>& all, const std::string& wanted) {
  std::vector<DicomSeries> matching;
  for (const DicomSeries& series : all)
    if (series.number == wanted || series.uid == wanted) matching.push_back(series);
  if (matching.empty())
    throw std::runtime_error("mri.series names no series here; found " + names_of(all));
  if (matching.size() > 1)
    throw std::runtime_error("mri.series names " + std::to_string(matching.size()) + " series: " +
                             names_of(matching) + "; expected one (give its SeriesInstanceUID)");
  return {matching.front(), {}, {}};
}

ChosenSeries choose_any(const std::vector<DicomSeries>& all) {
  constexpr std::size_t least_slices = 16;  // fewer is a localiser, not a breast
  std::vector<DicomSeries> matching;
  for (const DicomSeries& series : all)
    if (series.slices.size() >= least_slices) matching.push_back(series);
  check_one_patient(matching);
  if (matching.size() > 1) return choose_by_rule(matching);
  if (matching.size() == 1) return {matching.front(), {}, {}};
  if (all.size() == 1) return {all.front(), {}, {}};
  throw std::runtime_error("holds no MR series of at least " + std::to_string(least_slices) +
                           " slices; found " + names_of(all));
}

/// One patient's identifier in every slice: an archive that is wrongly sorted mixes two.
void check_slices_of_one_patient(const DicomSeries& series) {
  std::set<std::string> patients;
  for (const DicomSlice& slice : series.slices) patients.insert(slice.patient_id);
  if (patients.size() > 1)
    throw std::runtime_error(series.name() + " holds slices of " + std::to_string(patients.size()) +
                             " patients (by PatientID); expected one patient's (take the others "
                             "out, or export the series again)");
}

/// Leaves the slices of one phase in the series.
void choose_phase(DicomSeries& series, const std::string& wanted, std::vector<std::string>& notes) {
  std::vector<SlicePlacement> placements;
  for (const DicomSlice& slice : series.slices) placements.push_back(slice.placement);
  if (wanted.empty() && !has_repeated_positions(placements)) return;
  std::map<std::string, std::size_t> counts;
  for (const DicomSlice& slice : series.slices) ++counts[slice.phase];
  if (wanted.empty() && counts.size() == 1) return;  // repeated slices: the stack will say so
  std::vector<std::string> phases;
  for (const auto& [phase, count] : counts) phases.push_back(phase);
  std::stable_sort(phases.begin(), phases.end(),
                   [](const auto& a, const auto& b) { return number_before(a, b); });
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

ChosenSeries choose_series(const std::vector<DicomSeries>& all, const std::string& wanted) {
  const auto colon = std::min(wanted.find(':'), wanted.size());
  const std::string name = wanted.substr(0, colon);
  const std::string phase = colon < wanted.size() ? wanted.substr(colon + 1) : "";
  ChosenSeries out = name.empty() ? choose_any(all) : choose_named(all, name);
  if (out.notes.empty() && all.size() > 1)
    out.notes = {"of several series was read: " + out.series.name()};
  check_slices_of_one_patient(out.series);
  choose_phase(out.series, phase, out.notes);
  return out;
}

}  // namespace mammotwin
