#include "pipeline/report/drawing/jpeg.h"

#include <jpeglib.h>

#include <cstdio>  // jpeglib.h needs it
#include <cstdlib>
#include <vector>

namespace mammotwin {
namespace {

constexpr int kQuality = 90;  // of 100: a mammogram of 7 million pixels takes about a megabyte

}  // namespace

std::string grey_jpeg(int columns, int rows,
                      const std::function<void(int row, std::uint8_t* values)>& fill_row) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = columns;
  jpeg.image_height = rows;
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, kQuality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row(columns);
  for (int n = 0; n < rows; ++n) {
    fill_row(n, row.data());
    std::uint8_t* line = row.data();
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string text(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&jpeg);
  std::free(bytes);
  return text;
}

}  // namespace mammotwin
