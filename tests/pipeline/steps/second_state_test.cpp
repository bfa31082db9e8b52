#include "pipeline/steps/second_state.h"

#include <algorithm>
#include <cmath>

#include "segmentation/files/write_image_file.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {
namespace {

/// A flat slab of 30 x 30 x 10 mm with skin on top, no cut faces.
MeshFile mesh_of_a_slab() {
  MeshFile file{box_mesh({30, 30, 10}, {3, 3, 1}), {}, {}, {}, {}, {}};
  FaceLabels labels;
  labels.fill(FaceLabel::interior);
  labels[5] = FaceLabel::skin;
  file.faces.assign(file.mesh.num_elements(), labels);
  return file;
}

class SecondStateTest : public ScratchFolder {
 protected:
  /// Two triangles at the height z, wider than the slab.
  std::filesystem::path plane(double z, const std::string& name = "plane.obj") const {
    const std::string h = std::to_string(z);
    return write(name, "v -50 -50 " + h + "\nv 80 -50 " + h + "\nv 80 80 " + h + "\nv -50 80 " + h +
                           "\nf 1 2 3\nf 1 3 4\n");
  }
};

TEST_F(SecondStateTest, DistanceToASurfaceIsTheRootMeanSquare) {
  const MeshFile mesh = mesh_of_a_slab();
  const SecondState level(plane(12.5), mesh);
  EXPECT_NEAR(level.distance(mesh.mesh.nodes()), 2.5, 1e-6);
  // Tilted by z = z0 + x/10 over 0..30, at the middles of 12 strips of 2.5 mm.
  auto tilted = mesh.mesh.nodes();
  for (auto& node : tilted) node.row(2) += node.row(0) / 10;
  double sum = 0;
  for (int k = 0; k < 12; ++k) sum += std::pow(2.5 - 0.25 * (k + 0.5), 2) / 12;
  EXPECT_NEAR(level.distance(tilted), std::sqrt(sum), 1e-6);
}

// Voxels of 1 mm are air from z = 12 mm on, so their boundary stands at 11.5; a Gaussian of a voxel
// does not move a plane.
TEST_F(SecondStateTest, ReadsALabelMapToo) {
  std::vector<std::uint8_t> labels(60 * 60 * 40, 0);
  std::fill(labels.begin(), labels.begin() + 60 * 60 * 22, std::uint8_t{2});
  write_nrrd(folder_ / "labels.nrrd", {{60, 60, 40}, {1, 1, 1}, {-15, -15, -10}}, labels.data(), 1,
             {});
  const MeshFile mesh = mesh_of_a_slab();
  EXPECT_NEAR(SecondState(folder_ / "labels.nrrd", mesh).distance(mesh.mesh.nodes()), 1.5, 0.05);
}

TEST_F(SecondStateTest, SaysWhatIsWrong) {
  const MeshFile mesh = mesh_of_a_slab();
  EXPECT_NE(message_of([&] { SecondState(folder_ / "none.ply", mesh); }).find("no such file"),
            std::string::npos);
  EXPECT_NE(
      message_of([&] { SecondState(write("bad.stl", "solid nothing"), mesh); }).find("bad.stl"),
      std::string::npos);
  MeshFile bare = mesh_of_a_slab();
  for (auto& labels : bare.faces) labels[5] = FaceLabel::cut;
  EXPECT_NE(message_of([&] { SecondState(plane(12), bare); }).find("no skin"), std::string::npos);
}

}  // namespace
}  // namespace mammotwin
