#include "pipeline/slicer/scene.h"

#include <algorithm>

#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/figures/fit_error.h"
#include "pipeline/slicer/scene_nodes.h"
#include "pipeline/slicer/surface_file.h"

namespace mammotwin {
namespace {

constexpr int kSamples = 8;  // squares a side of an element's face
constexpr const char* kError = "skin_distance_mm";

/// "unloaded" -> "free of stress", "cc" -> "compressed in CC".
std::string in_words(const std::string& state) {
  if (state == "unloaded") return "free of stress";
  if (state == "cc" || state == "mlo") return "compressed in " + title_of_view(state);
  return state;
}

/// "ellipse_cc_1.mrk.json" -> "Lesion 1 in CC".
std::string ellipse_name(const std::string& file) {
  const std::string stem = file.substr(0, file.find('.'));
  const std::size_t view = stem.find('_') + 1, lesion = stem.find('_', view) + 1;
  return "Lesion " + stem.substr(lesion) + " in " +
         title_of_view(stem.substr(view, lesion - view - 1));
}

class Scene {
 public:
  Scene(const PatientResults& results, const FileWriter& write)
      : results_(results), write_(write) {}

  std::string text() {
    nodes_.begin_folder("Images and tissue");
    add_images();
    nodes_.begin_folder("Breast, surfaces");
    if (results_.prone) add_surfaces();
    nodes_.begin_folder("Lesions and nipple");
    for (const char* state : {"prone", "unloaded", "standing", "supine", "cc", "mlo"})
      add_lesions(state);
    nodes_.begin_folder("Search ellipses, in the prone MRI");
    add_ellipses();
    nodes_.begin_folder("Transforms of the MRI");
    for (const char* view : {"cc", "mlo"}) add_transform(view);
    nodes_.show_orientation();
    return nodes_.text();
  }

 private:
  bool has(const std::string& file) const {
    return std::binary_search(results_.files.begin(), results_.files.end(), file);
  }

  void add_images() {
    std::string mri;
    for (const char* view : {"cc", "mlo"})
      if (has("mri_in_" + std::string(view) + ".nrrd"))
        nodes_.add_volume("MRI in " + title_of_view(view), "mri_in_" + std::string(view) + ".nrrd");
    if (has("mri.nrrd")) {
      mri = nodes_.add_volume("MRI", "mri.nrrd");
      nodes_.show_in_slices(mri);
    }
    if (has("segmentation.seg.nrrd"))
      nodes_.add_segmentation("Tissue", "segmentation.seg.nrrd", mri);
  }

  void add_surface(const std::string& state, const HermiteMesh& mesh,
                   const PointNumbers& numbers = {}) {
    const std::string file = "scene_" + state + ".vtp";
    write_surface(write_(file), triangulate(mesh, outer_faces(*results_.prone), kSamples), numbers);
    nodes_.add_model("Breast, " + in_words(state), file, palette::skin, state == "prone",
                     numbers.name);
  }

  void add_surfaces() {
    PointNumbers errors{kError, fit_errors(results_, outer_faces(*results_.prone), kSamples)};
    if (errors.values.empty()) errors.name.clear();
    add_surface("prone", results_.prone->mesh, errors);
    if (results_.unloaded &&
        results_.unloaded->num_elements() == results_.prone->mesh.num_elements())
      add_surface("unloaded", *results_.unloaded);
    for (const ViewResult& view : results_.views) add_surface(view.view.name, view.file.mesh);
  }

  void add_lesions(const std::string& state) {
    const std::string file = "lesions_" + state + ".mrk.json";
    if (has(file))
      nodes_.add_markups("Lesions, " + in_words(state), file, palette::lesion, state == "prone");
  }

  /// What a view's search ellipses are in the prone MRI.
  void add_ellipses() {
    for (const std::string& file : results_.files)
      if (file.starts_with("ellipse_") && file.ends_with(".mrk.json"))
        nodes_.add_closed_curve(ellipse_name(file), file, palette::lesion, true);
  }

  /// The field on the compressed grid that says where its tissue was prone: what Slicer, as ITK,
  /// resamples the prone MRI with.
  void add_transform(const std::string& view) {
    const std::string file = "prone_from_" + view + ".nrrd";
    if (has(file)) nodes_.add_transform("Prone to " + title_of_view(view), file);
  }

  const PatientResults& results_;
  const FileWriter& write_;
  SceneNodes nodes_;
};

}  // namespace

std::string slicer_scene(const PatientResults& results, const FileWriter& write) {
  return Scene(results, write).text();
}

}  // namespace mammotwin
