#pragma once

#include <filesystem>
#include <string>

#include "registration/export/png_file.h"
#include "registration/view/detector.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// A view of a made-up exam, as a scanner's header would have it.
struct ExamView {
  std::string name;  ///< "cc", "mlo"
  Side side = Side::left;
  double angle_deg = 0;  ///< of the positioner
  double thickness_mm = 0;
};

/// An MRI as one MR image a slice, 1.dcm, 2.dcm, ... below `folder`: head first, prone. `seed`
/// gives patient and identifiers, the same ones each time. Throws std::runtime_error naming the
/// file that cannot be written.
void write_mri_series(const std::filesystem::path& folder, const Volume<std::int16_t>& image,
                      int seed);

/// A mammogram FOR PRESENTATION.
void write_mammogram(const std::filesystem::path& path, const GreyPixels& pixels,
                     const Detector& detector, const ExamView& view, int seed);

}  // namespace mammotwin
