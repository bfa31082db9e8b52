#include "segmentation/mri/load_series.h"

#include <algorithm>
#include <stdexcept>

#include "segmentation/files/slice_stack.h"

namespace mammotwin {

GridImage load_series(const DicomSeries& series) {
  std::vector<SlicePlacement> placements;
  for (const DicomSlice& slice : series.slices) placements.push_back(slice.placement);
  const SliceStack stack = stack_slices(placements);
  const SlicePlacement& first = placements[stack.order.front()];
  if (!(first.row_spacing > 0 && first.column_spacing > 0))
    throw std::runtime_error("PixelSpacing is missing or not positive; expected two numbers in mm");

  GridImage image;
  image.size = {first.columns, first.rows, static_cast<int>(stack.order.size())};
  image.spacing = {first.column_spacing, first.row_spacing, stack.spacing};
  image.origin = first.position;
  image.direction << first.along_row, first.along_column, first.normal();
  const std::size_t slice_size = static_cast<std::size_t>(first.columns) * first.rows;
  image.values.resize(slice_size * stack.order.size());
  std::filesystem::path loaded;
  std::vector<float> pixels;
  for (std::size_t n = 0; n < stack.order.size(); ++n) {
    const DicomSlice& slice = series.slices[stack.order[n]];
    if (slice.file != loaded) pixels = read_dicom_pixels(loaded = slice.file);
    if (pixels.size() < slice_size * (slice.frame + 1))
      throw std::runtime_error(slice.placement.name + ": has fewer pixels than its header says");
    std::copy_n(pixels.begin() + slice_size * slice.frame, slice_size,
                image.values.begin() + slice_size * n);
  }
  return image;
}

}  // namespace mammotwin
