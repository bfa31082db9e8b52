// register: compressed meshes + view geometry -> lesions on the CC and MLO detectors.

#include <cstdio>
#include <iostream>

#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/dicom_products.h"
#include "pipeline/steps/searched_views.h"
#include "pipeline/steps/view_header.h"
#include "registration/carry/point_carrier.h"
#include "registration/carry/ray_curve.h"
#include "registration/export/lesion_table.h"
#include "registration/export/markups.h"
#include "segmentation/files/segmentation_file.h"

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
    for (const char* key : {".detector.", ".mammogram", ".nipple_pixel"})
      stage.options_from(std::string("views.") + view + key, false);
  stage.options_from("register.", true);
  stage.command()
      .option("--landmarks", args.landmarks,
              "points found in MRI and mammograms (.csv): print how far predictions are off")
      .existing_file();
}

StagePlan plan(const Arguments& args, const Patient& patient) {
  StagePlan plan{{}, {"views.", "register.", "compress.", "materials.", "unload.density"}};
  for (const ViewSettings* view : {&patient.cc, &patient.mlo})
    if (view->mammogram) plan.inputs.push_back(patient.resolve(*view->mammogram));
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

/// What `lesions.csv` gives; half of this probability's semi-axes is 0.55 of them.
constexpr double kEllipseProbability = 0.9;
constexpr int kRimPoints = 36;

void set_ellipse(const SearchEllipse& ellipse, LesionRow& row) {
  row.ellipse_major_mm = ellipse.major_mm;
  row.ellipse_minor_mm = ellipse.minor_mm;
  row.ellipse_angle_deg = ellipse.angle_deg;
}

void set_picture_ellipse(const SearchEllipse& ellipse, LesionRow& row) {
  row.picture_ellipse_major_mm = ellipse.major_mm;
  row.picture_ellipse_minor_mm = ellipse.minor_mm;
  row.picture_ellipse_angle_deg = ellipse.angle_deg;
}

class Registration {
 public:
  Registration(const Segmentation& segmentation, const Patient& patient, StageRun& stage)
      : patient_(patient),
        stage_(stage),
        landmarks_(landmarks_of(segmentation)),
        nipple_{"nipple", segmentation.nipple_in_lps} {
    for (const Landmark& lesion : landmarks_)
      rows_.push_back(
          mri_row(patient_.name(), segmentation.region.side, lesion, nipple_.prone_in_lps));
    write_points("prone", [](const Landmark& landmark) { return landmark.prone_in_lps; });
    quality_["lesions"] = landmarks_.size();
  }

  void add(const RegisteredView& registered) {
    const ViewProjection& view = registered.projection;
    const ViewRays rays(registered.prone, registered.compressed, view.view(), view.detector());
    int number = 0;
    const ProjectedLandmark nipple = view.project(nipple_);
    for (const Landmark& landmark : landmarks_) {
      const ProjectedLandmark lesion = view.project(landmark);
      require_inside(lesion);
      if (lesion.on_detector.x() < 0)
        reasons_.push_back("lesion " + landmark.id + " lies behind the detector's edge in " +
                           view.view().name + ": that mammogram would not show it");
      rows_.push_back(view_row(patient_.name(), view.view(), lesion, nipple));
      if (const auto covariance = registered.covariance(lesion.point)) {
        SearchEllipse ellipse = search_ellipse(*covariance, kEllipseProbability);
        set_ellipse(ellipse, rows_.back());
        if (!patient_.view(view.view().name).mammogram) {
          ellipse = search_ellipse(registered.covariance_in_picture(lesion.point).value(),
                                   kEllipseProbability);
          set_picture_ellipse(ellipse, rows_.back());
        }
        write_closed_curve(stage_.products.write("ellipse_" + view.view().name + "_" +
                                                 std::to_string(++number) + ".mrk.json"),
                           landmark.id + " in " + view.view().name,
                           ellipse_in_prone(rays, lesion.on_detector, rim(ellipse, kRimPoints),
                                            lesion.in_view.z()));
      }
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

  /// For a view whose mammogram is a DICOM file.
  void export_dicom(const RegisteredView& registered, const DetectorImage& shown) {
    const auto mammogram = dicom_mammogram(patient_, registered.projection.view().name);
    if (!mammogram) return;
    write_dicom_products(registered, landmarks_, shown, *mammogram, stage_.products);
    quality_["dicom_export"] =
        "dicom/ carries the patient and study attributes of the mammograms, as dicom_export asks";
  }

  nlohmann::json& quality() { return quality_; }
  std::vector<std::string>& reasons() { return reasons_; }

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

  const Patient& patient_;
  StageRun& stage_;
  std::vector<Landmark> landmarks_;
  Landmark nipple_;
  std::vector<LesionRow> rows_;
  std::vector<std::string> reasons_;
  nlohmann::json quality_ = nlohmann::json::object();
};

Outcome run(const Arguments& args, const Patient& patient, StageRun& stage) {
  stage.progress(0, "reading");
  const Segmentation segmentation = read_segmentation(args.segmentation, args.fractions);
  std::optional<Volume<float>> mri;
  if (std::filesystem::exists(args.mri())) mri = read_image_file(args.mri());
  std::vector<RegisteredView> views;
  std::vector<std::string> remarks;
  for (const auto& [name, path] : {std::pair("cc", args.cc), std::pair("mlo", args.mlo)})
    views.push_back(read_registered_view(
        name, path, with_header(patient, name, segmentation.region.side, remarks)));
  Registration registration(segmentation, patient, stage);
  registration.reasons() = remarks;
  registration.add_states(views[0]);
  if (patient.registration.search)
    registration.quality()["search"] = search_and_register(
        patient, segmentation, views,
        [&](double done, const std::string& what) { stage.progress(0.8 * done, what); },
        registration.reasons());
  double done = 0.8;
  for (const RegisteredView& view : views) {
    stage.progress(done, view.projection.view().name);
    registration.add(view);
    write_registered_view(stage.products.write(view.projection.view().name + "_registered.vtu"),
                          view);
    const DetectorImage shown =
        write_view_files(view, segmentation, mri, stage.products, registration.quality());
    if (patient.registration.dicom_export) registration.export_dicom(view, shown);
    done += 0.1;
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
