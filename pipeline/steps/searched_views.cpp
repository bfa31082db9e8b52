#include "pipeline/steps/searched_views.h"

#include <stdexcept>

#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/view_header.h"
#include "pipeline/steps/view_problem.h"
#include "registration/mammogram/mammogram_findings.h"
#include "registration/mammogram/mammogram_pixels.h"

namespace mammotwin {
namespace {

using nlohmann::json;

ViewEvidence evidence_of(const Patient& patient, const RegisteredView& view) {
  const CompressedView& geometry = view.projection.view();
  const ViewSettings& settings = patient.view(geometry.name);
  const std::filesystem::path path = patient.resolve(*settings.mammogram);
  const Detector& detector = view.projection.detector();
  const std::string key = "views." + geometry.name;
  if (!detector.pixels)
    throw std::runtime_error(key + ".mammogram is given, but not " + key +
                             ".detector.pixel_spacing_mm, columns and rows");
  const MammogramImage image = read_mammogram(path);
  if (image.columns != detector.pixels->columns || image.rows != detector.pixels->rows)
    throw std::runtime_error(
        "the " + geometry.name + " mammogram has " + std::to_string(image.columns) + " x " +
        std::to_string(image.rows) + " pixels; " + key + ".detector says " +
        std::to_string(detector.pixels->columns) + " x " + std::to_string(detector.pixels->rows));
  const MammogramFindings found =
      find_breast(image, detector.pixels->spacing_mm, std::abs(geometry.angle_deg) > 15,
                  said_in(patient, settings));
  if (found.chest_wall != detector.pixels->chest_wall)
    throw std::runtime_error("the " + geometry.name + " mammogram" +
                             ": the breast lies on the image's other side than " + key +
                             ".detector.chest_wall says; is it the other breast, or mirrored?");
  return view_evidence(image, found, detector);
}

json figures_json(const MatchFigures& f) {
  return {{"outline_rms_mm", f.outline_rms_mm},
          {"nipple_mm", f.nipple_mm ? json(*f.nipple_mm) : json()},
          {"nipple_sd_mm", f.nipple_sd_mm},
          {"pattern_correlation", f.pattern_correlation ? json(*f.pattern_correlation) : json()},
          {"dense_detail_mm", f.dense_detail_mm ? json(*f.dense_detail_mm) : json()}};
}

json search_json(const SearchedView& view) {
  json state = json::object();
  for (int i = 0; i < kStates; ++i)
    state[kStateNames[i]] = {{"value", view.state[i]}, {"sd", view.state_sd[i]}};
  const ModelDiscrepancy& d = view.discrepancy;
  json refined;
  if (view.refinement) {
    refined = figures_json(view.refinement->left);
    refined["moved_rms_mm"] = view.refinement->rms_mm;
    refined["moved_most_mm"] = view.refinement->most_mm;
  }
  return {{"end", name_of(view.verdict.end)},
          {"reasons", view.verdict.reasons},
          {"discrepancy_mm",
           {{"outline", d.outline_mm},
            {"nipple", d.nipple_mm},
            {"pattern", d.pattern_mm},
            {"views", d.views_mm}}},
          {"state", state},
          {"before", figures_json(*view.before)},
          {"after", figures_json(*view.after)},
          {"refined", refined},
          {"baseline", view.baseline_left ? figures_json(*view.baseline_left) : json()},
          {"evidence_variance", view.evidence_variance},
          {"complete", view.complete},
          {"failed_solves", view.failed_solves}};
}

void judge(const SearchedView& view, std::vector<std::string>& reasons) {
  if (view.failed_solves == 2 * kMechanical)
    reasons.push_back(view.view.name +
                      ": no solve near the compressed state succeeded, so neither a search "
                      "nor ellipses that know the mechanics; run compress again");
  reasons.insert(reasons.end(), view.verdict.reasons.begin(), view.verdict.reasons.end());
}

SearchInput search_input(const Patient& patient, const Segmentation& segmentation,
                         const RegisteredView& view) {
  const CompressedView& geometry = view.projection.view();
  SearchInput input{
      view.file,
      geometry,
      view.projection.detector(),
      nearby_solver(patient, geometry, view.file, tissue_of(view.file, segmentation.fractions)),
      {}};
  if (patient.view(geometry.name).mammogram) input.evidence = evidence_of(patient, view);
  return input;
}

RegisteredView registered(RegisteredView view, const SearchedView& searched) {
  view.compressed = searched.compressed;
  view.uncertainty = searched.uncertainty;
  view.what_if = searched.what_if;
  view.end = searched.verdict.end;
  view.projection = ViewProjection(view.prone, view.compressed, searched.view,
                                   view.projection.detector(), searched.baseline);
  return view;
}

}  // namespace

RegisteredViews search_and_register(const Patient& patient, const Segmentation& segmentation,
                                    std::vector<RegisteredView> views, const Progress& progress) {
  std::vector<SearchInput> inputs;
  for (const RegisteredView& view : views)
    inputs.push_back(search_input(patient, segmentation, view));
  const std::vector<SearchedView> searched =
      search_views(inputs, segmentation.fractions, segmentation.nipple_in_lps, progress);
  RegisteredViews found;
  for (std::size_t v = 0; v < views.size(); ++v) {
    found.views.push_back(registered(std::move(views[v]), searched[v]));
    judge(searched[v], found.remarks);
    if (searched[v].after) found.figures[searched[v].view.name] = search_json(searched[v]);
  }
  return found;
}

}  // namespace mammotwin
