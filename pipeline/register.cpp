// register: compressed meshes + view geometry -> lesions on the CC and MLO detectors.

#include "pipeline/frame/stage.h"
#include "pipeline/registered_view.h"
#include "registration/lesion_table.h"
#include "registration/markups.h"
#include "registration/point_carrier.h"
#include "segmentation/segmentation_file.h"

#include <cstdio>
#include <iostream>

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path segmentation, fractions, cc, mlo, lesions, landmarks;

  /// Where segment has left the MRI; a patient that came as labels has none.
  std::filesystem::path mri() const { return segmentation.parent_path() / "mri.nrrd"; }
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.input("segmentation", args.segmentation, "tissue labels from segment (.seg.nrrd)");
  stage.input("fractions", args.fractions, "tissue fractions from segment (.nrrd)");
  stage.input("cc", args.cc, "breast compressed in CC (.vtu)");
  stage.input("mlo", args.mlo, "breast compressed in MLO (.vtu)");
  stage.product("lesions", args.lesions, "table of lesions to write (.csv; .mrk.json beside it)");
  for (const char* view : {"cc", "mlo"})
    stage.options_from(std::string("views.") + view + ".detector.", false);
  stage.app()
      .add_option("--landmarks", args.landmarks,
                  "points found in MRI and mammograms (.csv): print how far predictions are off")
      ->check(CLI::ExistingFile);
}

StagePlan plan(const Arguments& args, const Patient&) {
  StagePlan plan{{}, {"views.cc.detector.", "views.mlo.detector."}};
  if (std::filesystem::exists(args.mri())) plan.inputs.push_back(args.mri());
  if (!args.landmarks.empty()) plan.inputs.push_back(args.landmarks);
  return plan;
}

std::vector<Landmark> landmarks_of(const Segmentation& segmentation) {
  std::vector<Landmark> landmarks;
  for (const Lesion& lesion : segmentation.lesions)
    landmarks.push_back({lesion.id, lesion.centroid_in_lps});
  return landmarks;
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

  void add(const RegisteredView& registered) {
    const ViewProjection& view = registered.projection;
    const ProjectedLandmark nipple = view.project(nipple_);
    for (const Landmark& landmark : landmarks_) {
      const ProjectedLandmark lesion = view.project(landmark);
      require_inside(lesion);
      if (lesion.on_detector.x() < 0)
        reasons_.push_back("lesion " + landmark.id + " lies behind the detector's edge in " +
                           view.view().name + ": that mammogram would not show it");
      rows_.push_back(view_row(stage_.patient.name(), view.view(), lesion, nipple));
    }
    write_points(view.view().name,
                 [&](const Landmark& l) { return view.project(l).compressed_in_lps; });
    quality_["detectors"][view.view().name] = detector_json(view.detector());
  }

  /// Lesions and nipple as the breast hangs or lies in another state, for biopsy and radiotherapy.
  void add_states(const RegisteredView& registered) {
    for (const auto& [name, mesh] : registered.states) {
      const PointCarrier carrier(registered.prone, mesh);
      write_points(name, [&](const Landmark& l) { return carrier.carry(l.prone_in_lps).in_lps; });
    }
  }

  nlohmann::json& quality() { return quality_; }

  Outcome finish() {
    write_lesion_table(stage_.products.write_main(), rows_);
    if (landmarks_.empty())
      reasons_.push_back("patient.toml names no lesion, so there is nothing to predict");
    return {reasons_.empty() ? Status::ok : Status::look, reasons_, quality_};
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
  std::vector<std::string> reasons_;
  nlohmann::json quality_ = nlohmann::json::object();
};

Outcome run(const Arguments& args, StageRun& stage) {
  stage.progress(0, "reading");
  const Segmentation segmentation = read_segmentation(args.segmentation, args.fractions);
  std::optional<Volume<float>> mri;
  if (std::filesystem::exists(args.mri())) mri = read_image_file(args.mri());
  const RegisteredView views[] = {read_registered_view("cc", args.cc, stage.patient.cc),
                                  read_registered_view("mlo", args.mlo, stage.patient.mlo)};
  Registration registration(segmentation, stage);
  registration.add_states(views[0]);
  double done = 0.1;
  for (const RegisteredView& view : views) {
    stage.progress(done, view.projection.view().name);
    registration.add(view);
    write_view_files(view, segmentation, mri, stage.products, registration.quality());
    done += 0.4;
  }
  if (!args.landmarks.empty()) std::cout << landmark_errors(args.landmarks, views[0], views[1]);
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
