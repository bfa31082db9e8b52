#include "segmentation/mri/series_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>

namespace mammotwin {
namespace {

/// Computed from other images: told by the first value of ImageType, or by a later one, as scanners
/// call what they compute "original", too.
bool is_derived(const DicomSeries& series) {
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
std::vector<double> places_along(const DicomSeries& series) {
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
bool same_geometry(const DicomSeries& a, const DicomSeries& b) {
  const SlicePlacement &p = a.slices.front().placement, &q = b.slices.front().placement;
  return a.slices.size() == b.slices.size() && p.columns == q.columns && p.rows == q.rows &&
         std::abs(p.row_spacing - q.row_spacing) < same_place_mm;
}

/// The series that repeat one geometry three times or more, the longest such run: a dynamic study.
/// Empty without one.
std::vector<DicomSeries> dynamic_study(const std::vector<DicomSeries>& all) {
  constexpr std::size_t least_phases = 3;
  std::vector<DicomSeries> longest;
  for (const DicomSeries& first : all) {
    std::vector<DicomSeries> run;
    std::copy_if(all.begin(), all.end(), std::back_inserter(run),
                 [&](const DicomSeries& other) { return same_geometry(first, other); });
    if (run.size() >= least_phases && run.size() > longest.size()) longest = std::move(run);
  }
  return longest;
}

SeriesRow row_of(const DicomSeries& series, double first_seconds) {
  const std::vector<double> along = places_along(series);
  const SlicePlacement& place = series.slices.front().placement;
  SeriesRow row;
  row.uid = series.uid;
  row.number = series.short_number();
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
void number_phases(const std::vector<DicomSeries>& all, std::vector<SeriesRow>& rows) {
  std::vector<DicomSeries> originals = all;
  std::erase_if(originals, is_derived);
  std::vector<DicomSeries> dynamic = dynamic_study(originals);
  std::stable_sort(dynamic.begin(), dynamic.end(), [](const DicomSeries& a, const DicomSeries& b) {
    return a.slices.front().acquisition_time < b.slices.front().acquisition_time;
  });
  for (std::size_t p = 0; p < dynamic.size(); ++p)
    for (std::size_t n = 0; n < all.size(); ++n)
      if (all[n].uid == dynamic[p].uid) rows[n].phase = static_cast<int>(p) + 1;
}

}  // namespace

std::vector<SeriesRow> series_table(const std::vector<DicomSeries>& all) {
  constexpr int looked_at_phases = 2;  // the others look alike
  double first = seconds_of(all.front().slices.front().acquisition_time);
  for (const DicomSeries& series : all)
    first = std::min(first, seconds_of(series.slices.front().acquisition_time));
  std::vector<SeriesRow> rows;
  for (const DicomSeries& series : all) rows.push_back(row_of(series, first));
  number_phases(all, rows);
  for (std::size_t n = 0; n < all.size(); ++n)
    if (!rows[n].is_computed && rows[n].phase <= looked_at_phases)
      rows[n].look = look_at_series(all[n]);
  return rows;
}

}  // namespace mammotwin
