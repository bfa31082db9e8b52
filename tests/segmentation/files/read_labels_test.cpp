#include "segmentation/files/read_labels.h"

#include "tests/segmentation/message.h"
#include "tests/segmentation/nifti_file.h"

namespace mammotwin {
namespace {

TEST(ReadLabels, MustBeWholeNumbers) {
  const EmptyFolder folder("labels");
  auto values = counting(120);
  EXPECT_EQ(read_labels(write_nifti(folder.path / "a.nii", 4, 5, 6, values))(3, 4, 5), 119);
  values[3] = 0.5F;
  expect_mentions(
      message_of([&] { read_labels(write_nifti(folder.path / "b.nii", 4, 5, 6, values)); }),
      {"b.nii", "0.5", "whole"});
}

}  // namespace
}  // namespace mammotwin
