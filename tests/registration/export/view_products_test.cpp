#include "registration/export/view_products.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "registration/mammogram/mammogram_picture.h"
#include "tests/registration/squeezed_box.h"
#include "tests/scratch_file.h"

namespace mammotwin {
namespace {

TEST(ViewProducts, MriInTheViewShowsEachTissueWhereItWent) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  Volume<float> mri({130, 80, 100}, {1, 1, 1}, {10, -70, -50});
  for (int k = 0; k < mri.size.z(); ++k)
    for (int j = 0; j < mri.size.y(); ++j)
      for (int i = 0; i < mri.size.x(); ++i) {
        const Eigen::Vector3d x = mri.position(i, j, k);
        mri(i, j, k) = static_cast<float>(x.x() + 2 * x.y() - x.z());  // trilinear is exact on it
      }
  const Volume<float> there = mri_in_view(breast.prone, breast.compressed, mri);
  const Eigen::Vector3i v(30, 20, 15);
  const Eigen::Vector3d prone =
      breast.A.inverse() * (there.position(v.x(), v.y(), v.z()) - breast.b);
  EXPECT_NEAR(there(v.x(), v.y(), v.z()), prone.x() + 2 * prone.y() - prone.z(), 1e-3);  // floats
}

TEST(ViewProducts, PngHangsAsMammogramsDo) {
  DetectorImage shown;
  shown.columns = 3;
  shown.rows = 2;
  shown.values = {0.2, 0, 0, 0, 0, 1};  // at the wall medially 0.2, far laterally 1
  const auto path = scratch_file("view.png");
  write_view_png(path, shown, Side::left);
  MammogramImage image = read_mammogram_picture(path);
  EXPECT_EQ(image.at(0, 1), std::lround(0.2 * 65535));
  EXPECT_EQ(image.at(2, 0), 65535);
  write_view_png(path, shown, Side::right);
  image = read_mammogram_picture(path);
  EXPECT_EQ(image.at(2, 1), std::lround(0.2 * 65535));
  EXPECT_EQ(image.at(0, 0), 65535);
}

TEST(ViewProducts, FieldsComposeToIdentity) {
  const SqueezedBox breast = squeezed_box(Side::right, 45, 0.5);
  const ViewFields fields = view_fields(breast.prone, breast.compressed);
  EXPECT_LT(fields.error.max_mm, 1e-4);  // affine: only the floats' rounding
  EXPECT_GT(fields.error.points, 50000u);
}

}  // namespace
}  // namespace mammotwin
