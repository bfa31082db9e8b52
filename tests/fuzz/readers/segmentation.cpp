#include "segmentation/segmentation_file.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

/// Labels that somebody edited, beside fractions of a grid of 6 x 5 x 4 voxels.
void segmentation(const std::string& bytes) {
  static const std::filesystem::path fractions = [] {
    const auto path = fuzzed_file("fractions.nrrd", "");
    write_fractions(path, Volume<Fractions>({6, 5, 4}, {8, 8, 8}, {0, 0, 0}, Fractions{1, 0, 0}));
    return path;
  }();
  read_segmentation(fuzzed_file("a.seg.nrrd", bytes), fractions);
}

}  // namespace mammotwin::fuzz
