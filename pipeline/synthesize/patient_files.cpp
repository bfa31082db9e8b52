#include "pipeline/synthesize/patient_files.h"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/option_table.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double click_error_mm = 4;

/// To half a millimetre.
double asked_thickness(double extent_mm, const ViewOptions& views) {
  return std::round(2 * (1 - views.compressed_fraction) * extent_mm) / 2;
}

/// Micrometres are exact enough for a length in mm, and shorter than 17 digits.
double tidy(double value) { return std::round(value * 1000) / 1000; }

nlohmann::json point_json(const Vector3d& x) { return {tidy(x.x()), tidy(x.y()), tidy(x.z())}; }

nlohmann::json options_json(const PatientOptions& o) {
  nlohmann::json json{{"seed", o.anatomy.seed},
                      {"side", name_of(o.anatomy.side)},
                      {"contrast", name_of(o.scan.contrast)},
                      {"failed_suppression", o.scan.failed_suppression}};
  visit_numbers(o, [&](const char* name, const auto& value, double, double, const char*,
                       const char*) { json[name] = value; });
  return json;
}

nlohmann::json lesions_json(const SyntheticPatient& p) {
  nlohmann::json list = nlohmann::json::array();
  const auto clicked = clicked_points(p);
  for (std::size_t n = 0; n < clicked.size(); ++n) {
    const Lesion& lesion = p.truth.lesions[n];
    list.push_back({{"id", lesion.id},
                    {"centroid_lps_mm", point_json(lesion.centroid_in_lps)},
                    {"volume_ml", tidy(lesion.volume_ml)},
                    {"clicked_lps_mm", point_json(clicked[n])}});
  }
  return list;
}

}  // namespace

std::vector<Vector3d> clicked_points(const SyntheticPatient& p) {
  CounterRandom random(p.options.anatomy.seed, 101);
  std::vector<Vector3d> points;
  for (const Lesion& lesion : p.truth.lesions)
    points.push_back(lesion.centroid_in_lps + click_error_mm * random.direction());
  return points;
}

std::string patient_toml(const SyntheticPatient& p) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(1);
  out << "# A synthetic patient, made by mammotwin-synthesize; what is true of it is in "
         "truth.json.\n"
      << "side = \"" << name_of(p.options.anatomy.side)
      << "\"\nmaterials.preset = \"neo_hookean_2026\"  # the tissue that it was drawn "
         "with\n\n[mri]\npath = \"mri.nrrd\"\n";
  const auto clicked = clicked_points(p);
  for (std::size_t n = 0; n < clicked.size(); ++n)
    out << "\n[[lesions]]  # the point is " << click_error_mm
        << " mm off the true centroid\nid = \"" << p.truth.lesions[n].id << "\"\npoint_lps_mm = ["
        << clicked[n].x() << ", " << clicked[n].y() << ", " << clicked[n].z() << "]\n";
  out << "\n[views.cc]\nthickness_mm = " << asked_thickness(p.truth.cc_extent_mm, p.options.views)
      << "\n\n[views.mlo]\nthickness_mm = "
      << asked_thickness(p.truth.mlo_extent_mm, p.options.views)
      << "\nangle_deg = " << p.options.views.mlo_angle_deg << "\n";
  return out.str();
}

nlohmann::json truth_json(const SyntheticPatient& p) {
  const Truth& t = p.truth;
  return {{"options", options_json(p.options)},
          {"side", name_of(t.region.side)},
          {"region_mm",
           {{"x_min", tidy(t.region.x_min)},
            {"x_max", tidy(t.region.x_max)},
            {"z_min", tidy(t.region.z_min)},
            {"z_max", tidy(t.region.z_max)}}},
          {"breast_volume_ml", tidy(t.breast_ml)},
          {"fat_ml", tidy(t.fat_ml)},
          {"fibroglandular_ml", tidy(t.fibroglandular_ml)},
          {"skin_ml", tidy(t.skin_ml)},
          {"skin_thickness_mm", tidy(t.skin_thickness_mm)},
          {"nipple_lps_mm", point_json(t.nipple_in_lps)},
          {"lesions", lesions_json(p)},
          {"free_extent_mm", {{"cc", tidy(t.cc_extent_mm)}, {"mlo", tidy(t.mlo_extent_mm)}}},
          {"shading_ratio", tidy(t.shading_ratio)}};
}

}  // namespace mammotwin
