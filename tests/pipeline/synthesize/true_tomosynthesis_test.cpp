#include "pipeline/synthesize/views/true_tomosynthesis.h"

#include <gtest/gtest.h>

#include "registration/mammogram/header_geometry.h"
#include "registration/mammogram/mammogram_pixels.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

/// Fat with a ball of 4 mm of lesion in the prone box.
Volume<Fractions> ball_in_fat(const Eigen::Vector3d& centre) {
  Volume<Fractions> f({120, 80, 100}, {1, 1, 1}, {10, -70, -50});
  for (int k = 0; k < f.size.z(); ++k)
    for (int j = 0; j < f.size.y(); ++j)
      for (int i = 0; i < f.size.x(); ++i)
        ((f.position(i, j, k) - centre).norm() < 4 ? f(i, j, k).lesion : f(i, j, k).fat) = 1;
  return f;
}

double grey_at(const MammogramImage& image, const Eigen::Vector2d& pixel) {
  return image.at(static_cast<int>(std::lround(pixel.x())),
                  static_cast<int>(std::lround(pixel.y())));
}

class TrueTomosynthesis : public ScratchFolder {};

// What lies in a slice adds up in it: at its place the lesion is brightest there.
TEST_F(TrueTomosynthesis, ShowsALesionBrightestInItsSliceWhereTheFileSaysThatItIs) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  const Eigen::Vector3d lesion(75, -30, 14);
  const Volume<Fractions> tissue = ball_in_fat(lesion);
  const TomosynthesisVolume volume =
      tomosynthesis_volume(breast.prone, breast.compressed, &tissue, breast.view, std::nullopt, 1);
  const std::filesystem::path path = folder_ / "cc.dcm";
  write_tomosynthesis(path, volume, breast.view, 0, breast.view.thickness_mm);

  const HeaderGeometry g = header_geometry(read_mammogram_header(path), "cc", Side::left);
  const Eigen::Vector3d place = breast.view.frame.view_from_lps(breast.A * lesion + breast.b);
  const Eigen::Vector2d pixel = g.detector.image_from_detector(g.detector.project(place));
  const double slice = g.detector.slices->slice_at(place.z());
  int brightest = 0;
  double most = 0;
  for (int n = 1; n <= g.detector.slices->count; ++n) {
    const double grey = grey_at(read_mammogram_slice(path, n), pixel);
    if (grey > most) {
      most = grey;
      brightest = n;
    }
  }
  // 8 mm squeezed to 4: over 15 degrees it stays as bright over some 4 mm, and quanta tell them
  // apart.
  EXPECT_NEAR(brightest, slice, 3);
  EXPECT_GT(most, grey_at(read_mammogram_slice(path, g.detector.slices->count), pixel));
}

// A machine does not know how the breast came to lie on its detector.
TEST_F(TrueTomosynthesis, SaysTheMachinesAnglesHoweverTheBreastLies) {
  const SqueezedBox breast = squeezed_box(Side::left, 45, 0.5);
  const Volume<Fractions> tissue = ball_in_fat({75, -30, 14});
  TomosynthesisVolume volume =
      tomosynthesis_volume(breast.prone, breast.compressed, &tissue, breast.view, std::nullopt, 1);
  CompressedView lies = breast.view;
  lies.frame.axes = axes_of(lies.side, lies.angle_deg, -25);
  write_tomosynthesis(folder_ / "mlo.dcm", volume, lies, 45, lies.thickness_mm);

  const MammogramHeader header = read_mammogram_header(folder_ / "mlo.dcm");
  EXPECT_EQ(header.patient_orientation, (std::vector<std::string>{"A", "RF"}));
  EXPECT_NO_THROW(header_geometry(header, "mlo", Side::left));
}

}  // namespace
}  // namespace mammotwin
