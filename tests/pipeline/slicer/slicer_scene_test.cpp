// The scene for 3D Slicer, read by VTK and ITK and not by what wrote it.

#include <algorithm>

#include "pipeline/slicer/scene.h"
#include "pipeline/slicer/scene_nodes.h"
#include "registration/carry/displacement_field.h"
#include "registration/carry/point_carrier.h"
#include "registration/export/markups.h"
#include "segmentation/segmentation_file.h"
#include "tests/pipeline/report/report_fake_results.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/pipeline/slicer/scene_reader.h"

namespace mammotwin {
namespace {

Eigen::Vector3d vector_of(const Point& x) { return {x[0], x[1], x[2]}; }

/// A results folder as the stages leave it, and its scene.
class SlicerScene : public ScratchFolder {
 protected:
  void SetUp() override {
    write_image(folder_ / "mri.nrrd", *results_.mri);
    write_segmentation(folder_ / "segmentation.seg.nrrd", *results_.segmentation);
    const ViewResult& cc = *results_.view("cc");
    write_displacement_field(folder_ / "prone_from_cc.nrrd",
                             displacement_field(cc.file.mesh, results_.prone->mesh));
    std::vector<MarkupPoint> points;
    for (const Landmark& lesion : results_.lesions())
      points.push_back({lesion.id, lesion.prone_in_lps});
    write_markups(folder_ / "lesions_prone.mrk.json", points);
    write_closed_curve(folder_ / "ellipse_cc_1.mrk.json", "L1 in cc",
                       {{1, 2, 3}, {2, 3, 4}, {3, 5, 3}});
    results_.files = {"ellipse_cc_1.mrk.json", "lesions_prone.mrk.json", "mri.nrrd",
                      "prone_from_cc.nrrd", "segmentation.seg.nrrd"};
    const auto text =
        slicer_scene(results_, [&](const std::string& name) { return folder_ / name; });
    nodes_ = read_scene(write("scene.mrml", text));
  }
  /// The file behind an item of the scene.
  std::filesystem::path file_of(const std::string& name) const {
    for (const SceneNode& node : nodes_)
      if (node.attribute("name") == name)
        return folder_ / node_with_id(nodes_, node.reference("storage")).attribute("fileName");
    return {};
  }

  PatientResults results_ = fake_results(Side::left);
  std::vector<SceneNode> nodes_;
};

TEST_F(SlicerScene, RefersOnlyToNodesAndFilesThatAreThere) {
  std::vector<std::string> ids;
  for (const SceneNode& node : nodes_) ids.push_back(node.attribute("id"));
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
  int files = 0;
  for (const SceneNode& node : nodes_) {
    for (const std::string& id : node.references())
      EXPECT_TRUE(std::binary_search(ids.begin(), ids.end(), id)) << id;
    if (node.attribute("fileName").empty()) continue;
    EXPECT_TRUE(std::filesystem::exists(folder_ / node.attribute("fileName")))
        << node.attribute("fileName");
    ++files;
  }
  EXPECT_EQ(files, 1 + 1 + 4 + 1 + 1 +
                       1);  // MRI, segmentation, four surfaces, lesions, ellipse, transform
}

TEST_F(SlicerScene, SortsItsItemsIntoFoldersWithReadableNames) {
  std::map<std::string, std::string> folder_names;  // by item
  std::map<std::string, std::string> folder_of;     // by node
  for (const SceneNode& node : nodes_) {
    if (node.tag != "SubjectHierarchyItem") continue;
    if (node.attribute("dataNode").empty())
      folder_names[node.attribute("id")] = node.attribute("name");
    else
      folder_of[node.attribute("dataNode")] = folder_names[node.attribute("parent")];
  }
  const auto folder = [&](const std::string& name) {
    for (const SceneNode& node : nodes_)
      if (node.attribute("name") == name) return folder_of[node.attribute("id")];
    return "no " + name;
  };
  EXPECT_EQ(folder("Tissue"), "Images and tissue");
  EXPECT_EQ(folder("Breast, free of stress"), "Breast, surfaces");
  EXPECT_EQ(folder("Lesions, prone"), "Lesions and nipple");
  EXPECT_EQ(folder("Lesion 1 in CC"), "Search ellipses, in the prone MRI");
  EXPECT_EQ(folder("Prone to CC"), "Transforms of the MRI");
}

// Names of lesions stand in the files that the scene names, not in the scene; names of files do,
// and whatever they hold stays an attribute's value.
TEST_F(SlicerScene, HostileNamesStayText) {
  const std::string hostile = "</MRML><script>&'=cmd \u202egnp";
  for (LesionRow& row : results_.rows) row.lesion = hostile;
  for (Lesion& lesion : results_.segmentation->lesions) lesion.id = hostile;
  const auto write_beside = [&](const std::string& name) { return folder_ / name; };
  const std::string text = slicer_scene(results_, write_beside);
  EXPECT_EQ(text.find("script"), std::string::npos);
  EXPECT_EQ(read_scene(write("hostile.mrml", text)).size(), nodes_.size());
  SceneNodes scene;
  const std::string name = hostile + "\"\n";
  scene.add_model(name, name + ".vtp", {0, 0, 0}, true);
  int found = 0;
  for (const SceneNode& node : read_scene(write("names.mrml", scene.text())))
    found += node.attribute("name") == name || node.attribute("fileName") == name + ".vtp";
  EXPECT_GE(found, 2);
}

TEST_F(SlicerScene, LaysSurfacesWhereTheMeshIs) {
  for (const auto& [name, mesh] :
       {std::pair<std::string, const HermiteMesh*>{"Breast, prone", &results_.prone->mesh},
        {"Breast, compressed in CC", &results_.view("cc")->file.mesh}}) {
    const ReadSurface surface = read_surface_with_vtk(file_of(name));
    EXPECT_EQ(surface.space, "LPS");
    // 6 x 6 columns of 2 layers: 2 * 36 + 4 * 6 * 2 faces of 8 x 8 squares of two triangles.
    EXPECT_EQ(surface.triangles, (2 * 36 + 4 * 12) * 128);
    const Eigen::Vector3d corner = mesh->position({0, Eigen::Vector3d::Zero()});
    double nearest = 1e9;
    for (const Point& x : surface.points)
      nearest = std::min(nearest, (vector_of(x) - corner).norm());
    EXPECT_LT(nearest, 1e-4) << name;  // single precision
  }
  EXPECT_EQ(read_surface_with_vtk(file_of("Breast, prone")).numbers, "skin_distance_mm");
}

// ITK's transform takes a compressed point to where its tissue was prone. The field's voxels are
// 2 mm and the map is affine, so linear interpolation is exact to single precision.
TEST_F(SlicerScene, BringsALesionBackToTheMriThroughTheTransform) {
  const PointCarrier carrier(results_.prone->mesh, results_.view("cc")->file.mesh);
  for (const Landmark& lesion : results_.lesions()) {
    const Eigen::Vector3d compressed = carrier.carry(lesion.prone_in_lps).in_lps;
    const Point back = transformed_by_itk(file_of("Prone to CC"),
                                          {compressed.x(), compressed.y(), compressed.z()});
    EXPECT_LT((vector_of(back) - lesion.prone_in_lps).norm(), 0.01);
    EXPECT_GT((compressed - lesion.prone_in_lps).norm(), 1);
  }
}

TEST_F(SlicerScene, NamesImagesThatItkReadsOnOneGrid) {
  const ReadGrid mri = read_grid_with_itk(file_of("MRI")),
                 labels = read_grid_with_itk(file_of("Tissue"));
  const Eigen::Vector3i size = results_.mri->size;
  EXPECT_EQ(mri.size, (std::array<int, 3>{size.x(), size.y(), size.z()}));
  EXPECT_EQ(labels.size, mri.size);
  EXPECT_LT((vector_of(mri.origin) - results_.mri->origin).norm(), 1e-9);
  EXPECT_LT((vector_of(labels.origin) - vector_of(mri.origin)).norm(), 1e-9);
}

}  // namespace
}  // namespace mammotwin
