#include "registration/export/view_products.h"

#include <algorithm>
#include <cmath>

#include "segmentation/image/trilinear.h"

namespace mammotwin {

ViewFields view_fields(const HermiteMesh& prone, const HermiteMesh& compressed) {
  constexpr double tolerance = 0.05;  // [mm], where 0.1 is asked
  constexpr double fine = 1.5;        // [mm]; on 2 mm it cannot be corrected below 0.15 mm
  ViewFields fields{
      displacement_field(prone, compressed), displacement_field(compressed, prone, fine), {}};
  fields.error = compose_to_identity(fields.compressed_from_prone, prone, tolerance,
                                     fields.prone_from_compressed);
  return fields;
}

Volume<float> mri_in_view(const HermiteMesh& prone, const HermiteMesh& compressed,
                          const Volume<float>& mri) {
  constexpr double kVoxel_mm = 1;
  PositionGrid positions = cover(bounding_box(compressed), kVoxel_mm);
  fill_positions(compressed, prone, positions);
  Volume<float> image = positions.like<float>();
  for (std::size_t i = 0; i < image.values.size(); ++i)
    if (const Eigen::Vector3d& x = positions.values[i]; x.allFinite())
      image.values[i] = static_cast<float>(trilinear_corners(mri, mri.index(x)).of(mri));
  return image;
}

GreyPixels hung_pixels(const DetectorImage& shown, Side side) {
  GreyPixels pixels{shown.columns, shown.rows, {}};
  for (int row = 0; row < shown.rows; ++row)
    for (int column = 0; column < shown.columns; ++column) {
      const int from_wall = side == Side::left ? column : shown.columns - 1 - column;
      const double grey = std::clamp(shown.at(from_wall, shown.rows - 1 - row), 0.0, 1.0);
      pixels.grey.push_back(static_cast<std::uint16_t>(std::lround(65535 * grey)));
    }
  return pixels;
}

void write_view_png(const std::filesystem::path& path, const DetectorImage& shown, Side side) {
  write_png(path, hung_pixels(shown, side));
}

}  // namespace mammotwin
