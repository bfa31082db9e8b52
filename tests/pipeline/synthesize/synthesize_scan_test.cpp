#include <gtest/gtest.h>

#include "pipeline/synthesize/scan.h"
#include "pipeline/synthesize/tissue_map.h"

namespace mammotwin {
namespace {

double level(const ScanOptions& options, Substance s) {
  return intensities(options)[static_cast<std::size_t>(s)];
}

TEST(Scan, OnlyContrastAgentLiftsALesionOverGland) {
  ScanOptions before;
  before.contrast = ScanContrast::not_suppressed;
  before.lesion_to_gland = 1.78;
  ScanOptions after = before;
  after.contrast_agent = true;
  EXPECT_LT(level(before, Substance::lesion), level(before, Substance::fibroglandular));
  EXPECT_DOUBLE_EQ(level(after, Substance::lesion), 1.78 * level(after, Substance::fibroglandular));
  // Relative enhancement, which `segment` outlines lesions in: over 1 in a lesion, little in gland.
  const auto uptake = [&](Substance s) { return level(after, s) / level(before, s) - 1; };
  EXPECT_GT(uptake(Substance::lesion), 1);
  EXPECT_LT(uptake(Substance::fibroglandular), 0.2);
  EXPECT_EQ(uptake(Substance::fat), 0);
}

}  // namespace
}  // namespace mammotwin
