#include "segmentation/files/read_labels.h"

#include <cmath>
#include <stdexcept>

#include "segmentation/files/read_grid_image.h"
#include "segmentation/files/read_raw_image.h"

namespace mammotwin {

Volume<std::uint16_t> read_labels(const std::filesystem::path& path, HeaderKeys* keys) {
  try {
    check_is_there(path);
    if (!is_image_file_name(path))
      throw std::runtime_error("is not a label map; expected .nii, .nii.gz, .nrrd, .mha or .mhd");
    std::vector<std::string> notes;
    const Volume<float> raw = to_lps_grid(read_grid_image(path, keys), Between::nearest, notes);
    auto labels = raw.like<std::uint16_t>();
    for (std::size_t n = 0; n < raw.values.size(); ++n) {
      const float value = raw.values[n];
      if (!(value >= 0 && value <= 65535 && value == std::floor(value)))
        throw std::runtime_error("has the value " + std::to_string(value) +
                                 "; expected whole label numbers from 0 to 65535");
      labels.values[n] = static_cast<std::uint16_t>(value);
    }
    return labels;
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace mammotwin
