#include "pipeline/steps/registration_products.h"

#include <nlohmann/json.hpp>

#include "pipeline/frame/sentence.h"
#include "pipeline/steps/breast_problem.h"
#include "registration/carry/point_carrier.h"
#include "registration/carry/supine_place.h"
#include "registration/export/markups.h"
#include "registration/export/view_products.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

void set_ellipse(const LesionEllipse& ellipse, LesionRow& row) {
  row.ellipse_major_mm = ellipse.on_detector.major_mm;
  row.ellipse_minor_mm = ellipse.on_detector.minor_mm;
  row.ellipse_angle_deg = ellipse.on_detector.angle_deg;
  if (!ellipse.in_picture) return;
  row.picture_ellipse_major_mm = ellipse.in_picture->major_mm;
  row.picture_ellipse_minor_mm = ellipse.in_picture->minor_mm;
  row.picture_ellipse_angle_deg = ellipse.in_picture->angle_deg;
}

/// lesions_<configuration>.mrk.json: lesions, then the nipple.
void write_points(const std::string& configuration, const std::vector<MarkupPoint>& points,
                  Products& products) {
  write_markups(products.write("lesions_" + configuration + ".mrk.json"), points);
}

template <class Place>
std::vector<MarkupPoint> points_of(const Findings& findings, Place place) {
  std::vector<MarkupPoint> points;
  for (const Landmark& lesion : findings.lesions) points.push_back({lesion.id, place(lesion)});
  points.push_back({findings.nipple.id, place(findings.nipple)});
  return points;
}

/// Says beside each lesion how sure its place is.
void describe_spread(const Findings& findings, std::vector<MarkupPoint>& points) {
  for (std::size_t n = 0; n < findings.lesions.size(); ++n) {
    const Eigen::Vector3d semi =
        supine_semi_axes_mm(findings.lesions[n].prone_in_lps, findings.nipple.prone_in_lps);
    points[n].description = sentence(
        "90 %%, seen from the nipple: within %.0f mm to the sides, %.0f mm in depth, "
        "%.0f mm along the body",
        semi.x(), semi.y(), semi.z());
  }
}

std::vector<MarkupPoint> compressed_points(const ProjectedFindings& findings) {
  std::vector<MarkupPoint> points;
  for (const ProjectedLandmark& lesion : findings.lesions)
    points.push_back({lesion.landmark.id, lesion.compressed_in_lps});
  points.push_back({findings.nipple.landmark.id, findings.nipple.compressed_in_lps});
  return points;
}

}  // namespace

std::vector<LesionRow> lesion_rows(const std::string& patient, Side side, const Findings& findings,
                                   const std::vector<PredictedView>& views) {
  std::vector<LesionRow> rows;
  for (const Landmark& lesion : findings.lesions)
    rows.push_back(mri_row(patient, side, lesion, findings.nipple.prone_in_lps));
  for (const PredictedView& view : views)
    for (std::size_t i = 0; i < view.findings.lesions.size(); ++i) {
      rows.push_back(view_row(patient, view.registered.projection.view(), view.findings.lesions[i],
                              view.findings.nipple));
      rows.back().registration = name_of(view.registered.end);
      if (!view.ellipses.empty()) set_ellipse(view.ellipses[i], rows.back());
    }
  return rows;
}

void add_supine(const Findings& findings, const RegisteredView& view,
                std::vector<LesionRow>& rows) {
  const auto supine = view.states.find("supine");
  if (supine == view.states.end()) return;
  const MeshFile prone = prone_file(view.file);
  for (LesionRow& row : rows)
    for (const Landmark& lesion : findings.lesions) {
      if (row.view != "mri" || row.lesion != lesion.id) continue;
      const auto place = supine_place(prone, supine->second, view.projection.view().side,
                                      lesion.prone_in_lps, findings.nipple.prone_in_lps);
      if (!place) continue;
      row.supine_skin_l_mm = place->skin_in_lps.x();
      row.supine_skin_p_mm = place->skin_in_lps.y();
      row.supine_skin_s_mm = place->skin_in_lps.z();
      row.supine_depth_mm = place->depth_mm;
      row.supine_from_nipple_mm = place->from_nipple_mm;
      row.supine_clock = place->clock;
      row.supine_semi_l_mm = place->semi_axes_mm.x();
      row.supine_semi_p_mm = place->semi_axes_mm.y();
      row.supine_semi_s_mm = place->semi_axes_mm.z();
    }
}

void write_states(const Findings& findings, const RegisteredView& view, Products& products) {
  write_points("prone", points_of(findings, [](const Landmark& l) { return l.prone_in_lps; }),
               products);
  for (const auto& [name, mesh] : view.states) {
    const PointCarrier carrier(view.prone, mesh);
    const auto carried = [&](const Landmark& l) { return carrier.carry(l.prone_in_lps).in_lps; };
    std::vector<MarkupPoint> points = points_of(findings, carried);
    if (name == "supine") describe_spread(findings, points);
    write_points(name, points, products);
  }
}

void write_prediction(const PredictedView& view, Products& products) {
  const std::string& name = view.registered.projection.view().name;
  for (std::size_t i = 0; i < view.ellipses.size(); ++i)
    write_closed_curve(
        products.write("ellipse_" + name + "_" + std::to_string(i + 1) + ".mrk.json"),
        view.findings.lesions[i].landmark.id + " in " + name, view.ellipses[i].rim_in_prone);
  write_points(name, compressed_points(view.findings), products);
  write_registered_view(products.write(name + "_registered.vtu"), view.registered);
}

DetectorImage write_view_files(const RegisteredView& view, const Segmentation& segmentation,
                               const std::optional<Volume<float>>& mri, Products& products,
                               nlohmann::json& quality) {
  const CompressedView& geometry = view.projection.view();
  const std::string& name = geometry.name;
  const ViewFields fields = view_fields(view.prone, view.compressed);
  write_displacement_field(products.write(name + "_from_prone.nrrd"), fields.compressed_from_prone);
  write_displacement_field(products.write("prone_from_" + name + ".nrrd"),
                           fields.prone_from_compressed);
  quality["field_composition"][name] = {{"mean_mm", fields.error.mean_mm},
                                        {"p99_mm", fields.error.p99_mm},
                                        {"max_mm", fields.error.max_mm}};
  const SimulatedView simulated = simulate_view(
      view.prone, view.compressed, &segmentation.fractions, geometry, view.projection.detector());
  const DetectorImage shown = as_shown(simulated);
  write_view_png(products.write("simulated_" + name + ".png"), shown, geometry.side);
  if (mri)
    write_image(products.write("mri_in_" + name + ".nrrd"),
                mri_in_view(view.prone, view.compressed, *mri));
  return shown;
}

}  // namespace mammotwin
