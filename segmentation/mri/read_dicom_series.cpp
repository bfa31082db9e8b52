#include "segmentation/mri/read_dicom_series.h"

#include <algorithm>
#include <stdexcept>

#include "segmentation/mri/choose_series.h"
#include "segmentation/mri/dicom_series.h"
#include "segmentation/mri/load_series.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

DicomVolume read_dicom_series(const fs::path& path, const std::optional<std::string>& series) {
  DicomVolume out;
  try {
    const std::vector<fs::path> files = files_of(path);
    std::size_t set_aside = 0;
    const std::vector<DicomSeries> all = group_series(files, set_aside);
    if (all.empty())
      throw std::runtime_error("holds no MR image among " + std::to_string(files.size()) +
                               " file(s); expected DICOM (MR), or a NIfTI, NRRD or MHA file");
    if (set_aside > 0)
      out.notes.push_back(std::to_string(set_aside) +
                          " file(s) that are not MR images were left aside");
    ChosenSeries chosen = choose_series(all, series.value_or(""));
    out.notes.insert(out.notes.end(), chosen.notes.begin(), chosen.notes.end());
    out.series = std::move(chosen.weighed);
    const std::vector<DicomSlice>& slices = chosen.series.slices;
    out.geometry_known = slices.front().geometry_known;
    out.patient_position = slices.front().patient_position;
    out.image = load_series(chosen.series);
    for (const DicomSlice& slice : slices)
      if (out.files.empty() || out.files.back() != slice.file) out.files.push_back(slice.file);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return out;
}

}  // namespace mammotwin
