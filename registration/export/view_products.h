#pragma once

#include <filesystem>
#include <optional>

#include "registration/carry/displacement_field.h"
#include "registration/export/png_file.h"
#include "registration/prediction/project_lesions.h"
#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {

/// Fields of both directions between the prone and one compressed breast.
struct ViewFields {
  DisplacementField compressed_from_prone;  ///< on the prone grid
  DisplacementField prone_from_compressed;  ///< on the compressed grid: resamples the prone MRI
  CompositionError error;                   ///< there and back again from the prone grid
};
ViewFields view_fields(const HermiteMesh& prone, const HermiteMesh& compressed);

/// The prone MRI as it lies in the compressed breast, trilinear, on 1 mm voxels in LPS; 0 outside.
Volume<float> mri_in_view(const HermiteMesh& prone, const HermiteMesh& compressed,
                          const Volume<float>& mri);

/// The view as shown as 16-bit pixels, chest wall at the left edge for a left breast and at the
/// right for a right one, lateral up. `shown` has values in [0, 1].
GreyPixels hung_pixels(const DetectorImage& shown, Side side);

/// The same as PNG.
void write_view_png(const std::filesystem::path& path, const DetectorImage& shown, Side side);

}  // namespace mammotwin
