#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace mammotwin {

/// What is tried of a file: the header of a NIfTI, NRRD or MetaImage file, or all of a DICOM file.
enum class Trial { raw_header, dicom };

struct FailedTrial {
  std::size_t file = 0;    ///< index of the first that ends the program, or does not end
  bool timed_out = false;  ///< it does not end
};

/// Reads files in a program of its own (mammotwin-try-read, which lies beside this program or, once
/// installed, in ../libexec/mammotwin) and returns the first that ends it, for which it asks for
/// more memory or time than a file of that size can take, or that it does not finish within
/// `limit`. Exceptions count as survived. For libraries that stop the program over a damaged file
/// (GDCM asserts, in Debian's build, too) or read it for ever. Empty if all survive, or where that
/// program is not there or cannot be started.
std::optional<FailedTrial> first_fatal(Trial trial, const std::vector<std::filesystem::path>& files,
                                       std::chrono::milliseconds limit = std::chrono::seconds(60));

}  // namespace mammotwin
