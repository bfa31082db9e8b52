#include "pipeline/report/base64.h"
#include "pipeline/report/depth_image.h"
#include "pipeline/report/mesh_surface.h"
#include "pipeline/report/quality_table.h"
#include "pipeline/report/section.h"
#include "pipeline/report/verdict.h"
#include "report_fake_results.h"

#include "fitting/mesh/block_mesh.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace mammotwin {
namespace {

MeshFile block() { return {block_mesh({0, 0, 0}, {2, 3, 4}, {2, 1, 2}), {}, {}, {}, {}, {}}; }

TEST(MeshSurface, CountsEveryFaceOnce) {
  // 2 x 1 x 2 elements: 3*1*2 + 2*2*2 + 2*1*3 = 20 faces, of which 4 lie between two elements.
  EXPECT_EQ(all_faces(block()).size(), 20u);
  EXPECT_EQ(outer_faces(block()).size(), 16u);
}

TEST(MeshSurface, TrianglesLookOutwards) {
  const MeshFile file = block();
  const TriangleSurface s = triangulate(file.mesh, outer_faces(file), 3);
  double volume = 0;  // divergence theorem: a sum of signed tetrahedra
  for (const auto& [a, b, c] : s.triangles)
    volume += s.points[a].dot(s.points[b].cross(s.points[c])) / 6;
  EXPECT_NEAR(volume, 24, 1e-12);
}

TEST(MeshSurface, PlaneCutsABlockAlongItsOutlineAndItsInnerFaces) {
  const MeshFile file = block();
  double outline = 0, all = 0;
  for (const auto& [a, b] : cut_by_plane(file.mesh, outer_faces(file), 2, 1.1)) outline += (b - a).norm();
  for (const auto& [a, b] : cut_by_plane(file.mesh, all_faces(file), 2, 1.1)) all += (b - a).norm();
  EXPECT_NEAR(outline, 2 * (2 + 3), 1e-12);
  EXPECT_NEAR(all, outline + 3, 1e-12);
}

TEST(Section, TurnsAxesAndBack) {
  Section s;
  s.normal = 0;
  s.at = 5;
  s.right = {1};
  s.down = {2, true};
  s.window = Eigen::AlignedBox3d(Eigen::Vector3d(0, -10, -20), Eigen::Vector3d(1, 30, 40));
  EXPECT_EQ(s.on_paper({5, -10, 40}), Eigen::Vector2d(0, 0));
  const Eigen::Vector3d x(5, 12, -3);
  EXPECT_LT((s.in_space(s.on_paper(x)) - x).norm(), 1e-12);
}

TEST(DepthImage, KeepsWhatIsNearest) {
  const Colour red{1, 0, 0}, blue{0, 0, 1};
  const auto triangle = [](double z) {
    return std::array<Eigen::Vector3d, 3>{{{-9, -9, z}, {20, -9, z}, {-9, 20, z}}};
  };
  for (const bool near_first : {true, false}) {
    DepthImage image(4, 4, {0, 0}, 1);
    image.triangle(triangle(near_first ? 2 : 1), near_first ? red : blue);
    image.triangle(triangle(near_first ? 1 : 2), near_first ? blue : red);
    EXPECT_EQ(image.raster().pixels[5].red, 1);
  }
}

TEST(QualityTable, NamesUnitsAndUnfoldsLists) {
  const auto figures = quality_figures(nlohmann::json::parse(
      R"({"force_N": 86.41234, "min_J": null, "nipple_lps_mm": [1.5, -2, 3],
          "lesions": [{"id": "2a", "volume_ml": 0.4}], "history": [{"force_N": 1}]})"));
  ASSERT_EQ(figures.size(), 4u);
  EXPECT_EQ(figures[0].name + "|" + figures[0].value + "|" + figures[0].unit, "force|86.41|N");
  EXPECT_EQ(figures[1].name + "|" + figures[1].value + "|" + figures[1].unit, "lesions 2a, volume|0.4|ml");
  EXPECT_EQ(figures[2].value, "not known");
  EXPECT_EQ(figures[3].value + figures[3].unit, "(1.5, -2, 3)mm");
}

TEST(Verdict, IsTheWorstOfTheStages) {
  PatientResults results = fake_results(Side::left);
  EXPECT_EQ(verdict_data(results)["status"], "ok");
  results.stages[1].sidecar["status"] = "look";
  EXPECT_EQ(verdict_data(results)["status"], "look");
  results.stages[2].sidecar["status"] = "not_converged";
  results.stages[0].sidecar["status"] = "refused";
  EXPECT_EQ(verdict_data(results)["status"], "refused");
  results = fake_results(Side::left);
  results.stages.pop_back();
  EXPECT_EQ(verdict_data(results)["status"], "incomplete");
}

TEST(Base64, PadsAsOthersRead) {
  EXPECT_EQ(base64("", 0), "");
  EXPECT_EQ(base64("f", 1), "Zg==");  // RFC 4648, section 10
  EXPECT_EQ(base64("foobar", 6), "Zm9vYmFy");
}

}  // namespace
}  // namespace mammotwin
