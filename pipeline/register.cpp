// register: compressed meshes + view geometry -> lesions on the CC and MLO detectors.

#include "pipeline/frame/stage.h"
#include "registration/lesion_table.h"
#include "registration/markups.h"
#include "registration/project_lesions.h"
#include "segmentation/segmentation_file.h"

#include <cstdio>

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path segmentation, fractions, cc, mlo, lesions;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.input("segmentation", args.segmentation, "tissue labels from segment (.seg.nrrd)");
  stage.input("fractions", args.fractions, "tissue fractions from segment (.nrrd)");
  stage.input("cc", args.cc, "breast compressed in CC (.vtu)");
  stage.input("mlo", args.mlo, "breast compressed in MLO (.vtu)");
  stage.product("lesions", args.lesions, "table of lesions to write (.csv; .mrk.json beside it)");
  for (const char* view : {"cc", "mlo"})
    stage.options_from(std::string("views.") + view + ".detector.", false);
}

StagePlan plan(const Arguments&, const Patient&) {
  return {{}, {"views.cc.detector.", "views.mlo.detector."}};
}

std::vector<Landmark> landmarks_of(const Segmentation& segmentation) {
  std::vector<Landmark> landmarks;
  for (const Lesion& lesion : segmentation.lesions)
    landmarks.push_back({lesion.id, lesion.centroid_in_lps});
  return landmarks;
}

ViewProjection read_view(const std::string& name, const std::filesystem::path& path,
                         const ViewSettings& settings) {
  const MeshFile file = read_mesh_file(path);
  const auto prone = file.configurations.find("prone");
  if (prone == file.configurations.end())
    throw std::runtime_error(path.string() + ": has no configuration \"prone\"; was it made by compress?");
  const CompressedView view = compressed_view(name, path.filename().string(), file.metadata);
  return {HermiteMesh(prone->second, file.mesh.elements()), file.mesh, view,
          settings.detector(name, view.side)};
}

/// A lesion that the mesh does not hold has no position that could be trusted.
void require_inside(const ProjectedLandmark& lesion) {
  if (lesion.outside_mm <= kLesionOutsideLimit_mm) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "lesion %s lies %.1f mm outside the breast's mesh; at most %.0f mm can be carried: "
                "look at the chest wall and at the lesion's place in the report",
                lesion.landmark.id.c_str(), lesion.outside_mm, kLesionOutsideLimit_mm);
  throw std::runtime_error(text);
}

nlohmann::json detector_json(const Detector& detector) {
  return {{"source_distance_mm", detector.source_distance_mm},
          {"support_gap_mm", detector.support_gap_mm}};
}

class Registration {
 public:
  Registration(const Segmentation& segmentation, StageRun& stage)
      : stage_(stage), landmarks_(landmarks_of(segmentation)),
        nipple_{"nipple", segmentation.nipple_in_lps} {
    for (const Landmark& lesion : landmarks_)
      rows_.push_back(mri_row(stage.patient.name(), segmentation.region.side, lesion,
                              nipple_.prone_in_lps));
    write_points("prone", [](const Landmark& landmark) { return landmark.prone_in_lps; });
    quality_["lesions"] = landmarks_.size();
  }

  void add(const std::string& name, const ViewProjection& view) {
    const ProjectedLandmark nipple = view.project(nipple_);
    for (const Landmark& landmark : landmarks_) {
      const ProjectedLandmark lesion = view.project(landmark);
      require_inside(lesion);
      rows_.push_back(view_row(stage_.patient.name(), view.view(), lesion, nipple));
    }
    write_points(name, [&](const Landmark& l) { return view.project(l).compressed_in_lps; });
    quality_["detectors"][name] = detector_json(view.detector());
  }

  Outcome finish() {
    write_lesion_table(stage_.products.write_main(), rows_);
    if (!landmarks_.empty()) return {Status::ok, {}, quality_};
    return {Status::look, {"patient.toml names no lesion, so there is nothing to predict"}, quality_};
  }

 private:
  template <class Place>
  void write_points(const std::string& configuration, Place place) {
    std::vector<MarkupPoint> points;
    for (const Landmark& landmark : landmarks_) points.push_back({landmark.id, place(landmark)});
    points.push_back({nipple_.id, place(nipple_)});
    write_markups(stage_.products.write("lesions_" + configuration + ".mrk.json"), points);
  }

  StageRun& stage_;
  std::vector<Landmark> landmarks_;
  Landmark nipple_;
  std::vector<LesionRow> rows_;
  nlohmann::json quality_ = nlohmann::json::object();
};

Outcome run(const Arguments& args, StageRun& stage) {
  stage.progress(0, "reading");
  Registration registration(read_segmentation(args.segmentation, args.fractions), stage);
  stage.progress(0.3, "CC");
  registration.add("cc", read_view("cc", args.cc, stage.patient.cc));
  stage.progress(0.6, "MLO");
  registration.add("mlo", read_view("mlo", args.mlo, stage.patient.mlo));
  return registration.finish();
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "register",
                   "compressed meshes + view geometry -> lesions on the CC and MLO detectors",
                   declare, plan, run);
}
