// mark: marks on mammograms of a registered patient -> where they can be in MRI and in the other
// view.

#include <chrono>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/steps/registered_view.h"
#include "pipeline/steps/view_header.h"
#include "registration/export/markups.h"
#include "registration/export/view_products.h"
#include "registration/prediction/simulated_mammogram.h"
#include "registration/search/mark_curve.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  fs::path results, patient, markups, picture;
  std::vector<double> cc, mlo;
  bool millimetres = false;
};

void declare(CommandLine& command, Arguments& args) {
  command
      .option("results", args.results, "folder of a patient that mammotwin-register has finished")
      .required()
      .existing_folder();
  command.option("--cc", args.cc, "mark on the CC view: column, row").values(2);
  command.option("--mlo", args.mlo, "mark on the MLO view: column, row").values(2);
  command.flag("--mm", args.millimetres, "marks are u, v on the detector [mm]");
  command.option("--patient", args.patient, "patient.toml, for the detectors' geometry")
      .existing_file();
  command.option("--markups", args.markups, "curves and point for 3D Slicer to write (.mrk.json)");
  command.option("--picture", args.picture,
                 "other view with the curve of one mark to write (.png, 0.5 mm pixels)");
}

struct MarkedView {
  RegisteredView registered;
  ViewRays rays;
  std::optional<Eigen::Vector2d> mark;  ///< (u, v) [mm]
};

Eigen::Vector2d on_detector(const std::vector<double>& given, bool millimetres,
                            const Detector& detector) {
  const Eigen::Vector2d mark(given[0], given[1]);
  if (millimetres) return mark;
  if (!detector.pixels)
    throw std::runtime_error(
        "a mark in pixels needs views.*.detector.pixel_spacing_mm, columns and "
        "rows, or a DICOM mammogram, in the file of --patient; or give it with --mm");
  return detector.detector_from_image(mark);
}

MarkedView read_view(const std::string& name, const Arguments& args, const Patient& patient,
                     const std::vector<double>& mark) {
  const fs::path path = args.results / (name + "_registered.vtu");
  const MeshFile file = read_mesh_file(path);
  const Side side = compressed_view(name, path.filename().string(), file.metadata).side;
  std::vector<std::string> remarks;
  RegisteredView view = read_registered_view(name, path, with_header(patient, name, side, remarks));
  ViewRays rays(view.prone, view.compressed, view.projection.view(), view.projection.detector());
  std::optional<Eigen::Vector2d> uv;
  if (!mark.empty()) uv = on_detector(mark, args.millimetres, view.projection.detector());
  return {std::move(view), std::move(rays), uv};
}

json list_of(const Eigen::VectorXd& x) { return std::vector<double>(x.begin(), x.end()); }

MarkCurve curve_of(const MarkedView& marked, const MarkedView& other) {
  if (!marked.mark) return {};
  if (marked.rays.curve(*marked.mark, 2).empty())
    throw std::runtime_error(
        "the mark on " + marked.registered.projection.view().name +
        " lies off the breast: no ray through it meets tissue; expected column "
        "and row in the image, or u and v in mm with --mm");
  const auto& uncertainty = other.registered.uncertainty;
  return mark_curve(marked.rays, *marked.mark, other.rays, uncertainty ? &*uncertainty : nullptr);
}

/// One mark: its curve through MRI, and seen from the other view with the ellipse at each point.
json curve_json(const Eigen::Vector2d& mark, const MarkCurve& curve, const Detector& other) {
  json points = json::array();
  for (std::size_t n = 0; n < curve.on_ray.size(); ++n) {
    const RayPoint& p = curve.on_ray[n];
    const auto& [uv, ellipse] = curve.in_other[n];
    json point{{"height_mm", p.height_mm},
               {"lps_mm", list_of(p.prone_in_lps)},
               {"other_view_mm", list_of(uv)}};
    if (other.pixels) point["other_view_pixel"] = list_of(other.image_from_detector(uv));
    if (ellipse)
      point["other_view_ellipse"] = {{"major_mm", ellipse->major_mm},
                                     {"minor_mm", ellipse->minor_mm},
                                     {"angle_deg", ellipse->angle_deg}};
    points.push_back(std::move(point));
  }
  return {{"mark_mm", list_of(mark)}, {"curve", points}};
}

/// What the marks say together.
struct Answer {
  MarkCurve cc, mlo;
  std::optional<ClosestApproach> both;
};

Answer answer_of(const MarkedView& cc, const MarkedView& mlo) {
  Answer answer{curve_of(cc, mlo), curve_of(mlo, cc), {}};
  if (cc.mark && mlo.mark)
    answer.both = closest_approach(cc.rays, *cc.mark, answer.cc.on_ray, mlo.rays, *mlo.mark,
                                   answer.mlo.on_ray);
  return answer;
}

json answer_json(const Answer& answer, const MarkedView& cc, const MarkedView& mlo) {
  json said = json::object();
  if (cc.mark) said["cc"] = curve_json(*cc.mark, answer.cc, mlo.rays.detector());
  if (mlo.mark) said["mlo"] = curve_json(*mlo.mark, answer.mlo, cc.rays.detector());
  if (!cc.mark || !mlo.mark) return said;
  said["point_lps_mm"] = answer.both ? list_of(answer.both->prone_in_lps) : json();
  said["gap_mm"] = answer.both ? json(answer.both->gap_mm) : json();
  return said;
}

std::vector<MarkupPoint> markups_of(const MarkedView& cc, const MarkedView& mlo,
                                    const std::optional<ClosestApproach>& both) {
  std::vector<MarkupPoint> points;
  for (const MarkedView* view : {&cc, &mlo}) {
    if (!view->mark) continue;
    for (const RayPoint& p : view->rays.curve(*view->mark, 2))
      points.push_back({view->registered.projection.view().name + " " +
                            std::to_string(static_cast<int>(std::lround(p.height_mm))) + " mm",
                        p.prone_in_lps});
  }
  if (both) points.push_back({"both", both->prone_in_lps});
  return points;
}

/// The other view as simulated (without tissue: outline and thickness), the curve in white.
void draw(const fs::path& path, const MarkedView& marked, const MarkedView& other) {
  const RegisteredView& view = other.registered;
  const SimulatedView simulated = simulate_view(view.prone, view.compressed, nullptr,
                                                view.projection.view(), view.projection.detector());
  DetectorImage shown = as_shown(simulated);
  for (const Eigen::Vector2d& uv :
       curve_in_other_view(marked.rays, *marked.mark, other.rays, 0.2)) {
    const Eigen::Vector2d at = (uv - shown.first) / shown.spacing_mm;
    const int i = static_cast<int>(std::lround(at.x())), j = static_cast<int>(std::lround(at.y()));
    for (int b = j - 1; b <= j + 1; ++b)
      for (int a = i - 1; a <= i + 1; ++a)
        if (a >= 0 && b >= 0 && a < shown.columns && b < shown.rows)
          shown.values[static_cast<std::size_t>(b) * shown.columns + a] = 1;
  }
  write_view_png(path, shown, view.projection.view().side);
}

int run(const Arguments& args) {
  if (args.cc.empty() && args.mlo.empty())
    throw std::runtime_error("no mark: give --cc COLUMN ROW, --mlo COLUMN ROW, or both");
  Patient patient;
  if (!args.patient.empty()) patient.read(args.patient);
  const MarkedView cc = read_view("cc", args, patient, args.cc);
  const MarkedView mlo = read_view("mlo", args, patient, args.mlo);
  const auto start = std::chrono::steady_clock::now();
  const Answer answer = answer_of(cc, mlo);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << answer_json(answer, cc, mlo).dump(1) << std::endl;
  std::cerr << "mark: " << 1e3 * seconds << " ms after reading" << std::endl;
  if (!args.markups.empty()) write_markups(args.markups, markups_of(cc, mlo, answer.both));
  if (!args.picture.empty()) cc.mark ? draw(args.picture, cc, mlo) : draw(args.picture, mlo, cc);
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "mark",
                                      "Marks on mammograms of a registered patient: their curves "
                                      "through MRI and in the other view, and "
                                      "from two marks the point in MRI",
                                      declare, run);
}
