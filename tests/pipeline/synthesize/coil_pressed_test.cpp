#include "pipeline/synthesize/coil_pressed.h"

#include <gtest/gtest.h>

#include "fitting/mesh/block_mesh.h"

namespace mammotwin {
namespace {

constexpr std::int16_t kTissue = 100;
constexpr double kHangs_mm = 100, kPressed_mm = 30;

/// A block of tissue that hangs along z, in air.
SyntheticPatient hanging_block() {
  SyntheticPatient patient;
  Volume<std::int16_t>& image = patient.scan.image;
  image = Volume<std::int16_t>({41, 41, 61}, {3, 3, 3}, {-60, -60, 0}, 0);
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const Eigen::Vector3d x = image.position(i, j, k);
        if (std::abs(x.x()) < 40 && std::abs(x.y()) < 40 && x.z() < kHangs_mm)
          image(i, j, k) = kTissue;
      }
  return patient;
}

std::int16_t imaged_at(const SyntheticPatient& patient, double height_mm) {
  const Eigen::Vector3d index = patient.scan.image.index({0, 0, height_mm});
  return patient.scan.image(static_cast<int>(std::lround(index.x())),
                            static_cast<int>(std::lround(index.y())),
                            static_cast<int>(std::lround(index.z())));
}

// What goes along less and less would bring back, in front of it, the breast that hung there.
TEST(ImagedPressed, ShowsAirWhereTheBreastHungBeforeItWasPressed) {
  const Eigen::Vector3d low(-40, -40, 0);
  const HermiteMesh prone = block_mesh(low, {40, 40, kHangs_mm}, {1, 1, 2}),
                    pressed = block_mesh(low, {40, 40, kPressed_mm}, {1, 1, 2});
  const SyntheticPatient imaged = imaged_pressed(hanging_block(), prone, pressed);
  for (const double height_mm : {6., 15., 24.}) EXPECT_EQ(imaged_at(imaged, height_mm), kTissue);
  for (const double height_mm : {36., 51., 69., 84.}) EXPECT_EQ(imaged_at(imaged, height_mm), 0);
}

}  // namespace
}  // namespace mammotwin
