#pragma once

#include <filesystem>

#include "segmentation/image/volume.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Writes the labels as `.seg.nrrd`, which 3D Slicer opens as a segmentation with named, coloured
/// segments; region, nipple, lesions and side stand in its header as `mammotwin_*`.
void write_segmentation(const std::filesystem::path& path, const Segmentation& segmentation);

/// Writes a vector NRRD: fat, fibroglandular, lesion, each in [0, 1].
void write_fractions(const std::filesystem::path& path, const Volume<Fractions>& fractions);

/// Writes a scalar NRRD.
void write_image(const std::filesystem::path& path, const Volume<float>& image);

/// For tools that read NIfTI (.nii.gz): voxels only, without names or landmarks.
void write_nifti_labels(const std::filesystem::path& path, const Volume<std::uint8_t>& labels);
void write_nifti_image(const std::filesystem::path& path, const Volume<float>& image);

/// Reads what the two functions above wrote, edited or not. Where the header has lost its
/// `mammotwin_*` keys, region, nipple and lesions are found anew from the labels, and the side is
/// the one with labels. Throws std::runtime_error if the two files do not share one grid.
Segmentation read_segmentation(const std::filesystem::path& labels,
                               const std::filesystem::path& fractions);

Volume<float> read_image_file(const std::filesystem::path& path);

}  // namespace mammotwin
