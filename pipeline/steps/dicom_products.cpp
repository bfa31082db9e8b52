#include "pipeline/steps/dicom_products.h"

#include "registration/export/dicom_export.h"
#include "registration/export/view_products.h"

namespace mammotwin {
namespace {

std::vector<AnnotatedMark> marks_of(const RegisteredView& view,
                                    const std::vector<Landmark>& lesions) {
  std::vector<AnnotatedMark> marks;
  for (const Landmark& lesion : lesions) {
    const ProjectedLandmark found = view.projection.project(lesion);
    AnnotatedMark mark{lesion.id, found.on_detector, {}, lesion.prone_in_lps, found.in_view.z()};
    if (const auto covariance = view.covariance(found.point))
      mark.ellipse = search_ellipse(*covariance, 0.9);
    marks.push_back(mark);
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

void write_dicom_products(const RegisteredView& view, const std::vector<Landmark>& lesions,
                          const DetectorImage& shown, const std::filesystem::path& mammogram,
                          Products& products) {
  const CompressedView& geometry = view.projection.view();
  const std::vector<AnnotatedMark> marks = marks_of(view, lesions);
  const auto file = [&](const char* what) {
    return products.write("dicom/" + geometry.name + what);
  };
  write_presentation_state(file("_gsps.dcm"), mammogram, view.projection.detector(), marks,
                           geometry.name);
  write_measurement_report(file("_sr.dcm"), mammogram, marks, geometry.name);
  write_simulated_mammogram(file("_simulated.dcm"), mammogram, hung_pixels(shown, geometry.side),
                            shown.spacing_mm, orientation_of(geometry), geometry.name);
}

}  // namespace mammotwin
