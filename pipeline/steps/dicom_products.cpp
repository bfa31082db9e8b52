#include "pipeline/steps/dicom_products.h"

#include "registration/export/dicom/dicom_export.h"
#include "registration/export/view_products.h"
#include "registration/mammogram/mammogram_header.h"
#include "segmentation/mri/read_mri.h"

namespace mammotwin {
namespace {

std::vector<AnnotatedMark> marks_of(const PredictedView& view) {
  std::vector<AnnotatedMark> marks;
  for (std::size_t i = 0; i < view.findings.lesions.size(); ++i) {
    const ProjectedLandmark& lesion = view.findings.lesions[i];
    AnnotatedMark& mark = marks.emplace_back();
    mark.id = lesion.landmark.id;
    mark.on_detector = lesion.on_detector;
    if (!view.ellipses.empty()) mark.ellipse = view.ellipses[i].on_detector;
    mark.prone_in_lps = lesion.landmark.prone_in_lps;
    mark.height_mm = lesion.in_view.z();
    if (lesion.slice)
      mark.slice = view.registered.projection.detector().slices->nearest(*lesion.slice);
  }
  return marks;
}

/// As the simulated view hangs: chest wall left for a left breast, lateral or head up.
std::string orientation_of(const CompressedView& view) {
  const bool left = view.side == Side::left;
  const std::string down = view.name == "cc" ? (left ? "R" : "L") : "F";
  return std::string(left ? "A" : "P") + "\\" + down;
}

}  // namespace

void write_dicom_products(const PredictedView& view, const DetectorImage& shown,
                          const std::filesystem::path& mammogram, Products& products) {
  const ViewProjection& projection = view.registered.projection;
  const CompressedView& geometry = projection.view();
  const std::vector<AnnotatedMark> marks = marks_of(view);
  const auto file = [&](const char* what) {
    return products.write("dicom/" + geometry.name + what);
  };
  write_presentation_state(file("_gsps.dcm"), mammogram, projection.detector(), marks,
                           geometry.name);
  write_measurement_report(file("_sr.dcm"), mammogram, projection.detector(), geometry.side, marks,
                           geometry.name);
  write_simulated_view(file("_simulated.dcm"), mammogram, hung_pixels(shown, geometry.side),
                       shown.spacing_mm, orientation_of(geometry), geometry.name);
}

void write_dicom_segmentation(const Patient& patient, const Segmentation& segmentation,
                              Products& products) {
  if (patient.scan_file() || !has_lesion_voxels(segmentation)) return;
  const SegmentInput input = patient.segment_input();
  if (!input.mri) return;
  const std::vector<std::filesystem::path> files = read_mri(*input.mri, input.series).files;
  if (files.empty() || !is_dicom(files.front())) return;
  write_lesion_segmentation(products.write("dicom/lesions_seg.dcm"), files, segmentation);
}

}  // namespace mammotwin
