#pragma once

#include <filesystem>

#include "segmentation/segment.h"
#include "segmentation/segmentation_file.h"
#include "tests/segmentation/phantom.h"

namespace mammotwin {

/// Writes its image as mri.nrrd.
inline std::filesystem::path write_phantom(const std::filesystem::path& folder,
                                           const Phantom& phantom) {
  write_image(folder / "mri.nrrd", phantom.image());
  return folder / "mri.nrrd";
}

/// That image with a point in the lesion, `off` its middle [mm].
inline SegmentInput input_for(const std::filesystem::path& mri, const Phantom& phantom,
                              const Eigen::Vector3d& off = Eigen::Vector3d(2, -2, 2)) {
  SegmentInput input;
  input.mri = mri;
  input.lesions = {{"L1", phantom.lesion + off, {}, {}, {}, {}}};
  return input;
}

}  // namespace mammotwin
