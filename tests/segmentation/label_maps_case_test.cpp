#include "segmentation/body/breast_region.h"
#include "segmentation/files/read_labels.h"
#include "segmentation/label_maps/label_values.h"
#include "tests/segmentation/cases.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

const LabelValues acpelicano{
    {0, ForeignTissue::air},    {1, ForeignTissue::fat},       {2, ForeignTissue::fibroglandular},
    {3, ForeignTissue::skin},   {4, ForeignTissue::muscle},    {5, ForeignTissue::lesion},
    {6, ForeignTissue::lesion}, {7, ForeignTissue::transition}};

/// Tissue before the muscle inside the region [ml].
double volume_ml(const Volume<std::uint8_t>& labels, const BreastRegion& region) {
  double count = 0;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i) {
      if (!region.contains(labels.position(i, 0, k))) continue;
      for (int j = 0; j < labels.size.y() && labels(i, j, k) != label::muscle; ++j)
        count += label::is_breast(labels(i, j, k));
    }
  return count * labels.voxel_volume() / 1000;
}

TEST(LabelMaps, EveryBreastHasARegionOfPlausibleVolume) {
  MAMMOTWIN_NEED_CASE(label_maps, "label_maps");
  for (const auto& entry : fs::directory_iterator(label_maps)) {
    const MappedLabels mapped = map_labels(read_labels(entry.path()), acpelicano);
    for (const Side side : {Side::left, Side::right}) {
      const BreastRegion r = find_breast_region(mapped.labels, side);
      const double ml = volume_ml(mapped.labels, r);
      // 590 to 1960 ml by an independent prototype of the same rule; its edges differ by some mm.
      EXPECT_GT(ml, 550) << entry.path().filename();
      EXPECT_LT(ml, 2150) << entry.path().filename();
      std::cout << entry.path().filename().string() << (side == Side::left ? " left " : " right ")
                << ml << " ml, x " << r.x_min << " to " << r.x_max << ", z " << r.z_min << " to "
                << r.z_max << "\n";
    }
  }
}

}  // namespace
}  // namespace mammotwin
