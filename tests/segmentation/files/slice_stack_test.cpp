#include "segmentation/files/slice_stack.h"

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

SlicePlacement axial(int n, double z) {
  SlicePlacement slice;
  slice.name = "IM" + std::to_string(n);
  slice.position = {-100, -50, z};
  slice.along_row = {1, 0, 0};
  slice.along_column = {0, 1, 0};
  slice.rows = slice.columns = 64;
  slice.row_spacing = slice.column_spacing = 1;
  return slice;
}

std::vector<SlicePlacement> ten_slices() {
  std::vector<SlicePlacement> slices;
  for (int n = 0; n < 10; ++n) slices.push_back(axial(n, 20 - 2 * n));  // feet last
  return slices;
}

TEST(SliceStack, IsOrderedAlongItsNormal) {
  const SliceStack stack = stack_slices(ten_slices());
  EXPECT_NEAR(stack.spacing, 2, 1e-12);
  EXPECT_EQ(stack.order.front(), 9U);
  EXPECT_EQ(stack.order.back(), 0U);
}

TEST(SliceStack, NamesAHoleAndTheSlicesOnBothSides) {
  auto slices = ten_slices();
  slices.erase(slices.begin() + 3, slices.begin() + 6);  // z = 14, 12, 10 missing: 16 to 8
  expect_mentions(message_of([&] { stack_slices(slices); }),
                  {"hole of 8.0 mm", "IM6 (at 8.0 mm)", "IM2 (at 16.0 mm)", "every 2.0 mm"});
}

TEST(SliceStack, RefusesTwoSlicesAtOnePlace) {
  auto slices = ten_slices();
  slices.push_back(axial(77, 14));
  EXPECT_TRUE(has_repeated_positions(slices));
  expect_mentions(message_of([&] { stack_slices(slices); }), {"one place", "IM3", "IM77"});
}

TEST(SliceStack, RefusesSlicesThatAreNotParallel) {
  auto slices = ten_slices();
  slices[4].along_column = {0, 0, -1};
  expect_mentions(message_of([&] { stack_slices(slices); }), {"not parallel", "IM0", "IM4"});
}

TEST(SliceStack, RefusesASingleImage) {
  expect_mentions(message_of([&] { stack_slices({axial(0, 0)}); }), {"two-dimensional"});
}

TEST(SliceStack, RefusesAnotherMatrix) {
  auto slices = ten_slices();
  slices[5].rows = 32;
  expect_mentions(message_of([&] { stack_slices(slices); }), {"IM5", "32 x 64", "64 x 64"});
}

TEST(SliceStack, RefusesASidewaysShift) {
  auto slices = ten_slices();
  slices[5].position.x() += 4;
  expect_mentions(message_of([&] { stack_slices(slices); }), {"sideways", "IM5"});
}

}  // namespace
}  // namespace mammotwin
