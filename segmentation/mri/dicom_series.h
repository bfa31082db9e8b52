#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/files/dicom_slice.h"

namespace mammotwin {

/// Slices that share a SeriesInstanceUID.
struct DicomSeries {
  std::string uid, number;
  std::vector<DicomSlice> slices;

  /// The series number; empty where its length is an identifier's, which may name somebody.
  std::string short_number() const;
  /// What tells it apart and names nobody: descriptions and file names may hold anything.
  std::string name() const;
};

/// Names of all of them, for messages.
std::string names_of(const std::vector<DicomSeries>& all);

/// The MR series among the files, in the order of their numbers; `set_aside` counts files that are
/// no MR images. Throws std::runtime_error where the DICOM library would end the program over one
/// of the files, or never end.
std::vector<DicomSeries> group_series(const std::vector<std::filesystem::path>& files,
                                      std::size_t& set_aside);

/// Order of whole numbers written as text.
bool number_before(const std::string& a, const std::string& b);

}  // namespace mammotwin
