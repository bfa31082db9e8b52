#include "pipeline/report/page_data.h"

#include <algorithm>
#include <iterator>

#include "pipeline/report/answer_data.h"
#include "pipeline/report/figures/convergence_figure.h"
#include "pipeline/report/figures/doubt_figure.h"
#include "pipeline/report/figures/fit_course_figure.h"
#include "pipeline/report/figures/fit_error.h"
#include "pipeline/report/figures/force_figure.h"
#include "pipeline/report/figures/frames_figure.h"
#include "pipeline/report/figures/mri_figure.h"
#include "pipeline/report/figures/render_figure.h"
#include "pipeline/report/lesion_data.h"
#include "pipeline/report/live/base64.h"
#include "pipeline/report/live/carry_data.h"
#include "pipeline/report/live/scene_data.h"
#include "pipeline/report/live/views_data.h"
#include "pipeline/report/live/volume_data.h"
#include "pipeline/report/live/what_if_data.h"
#include "pipeline/report/quality_limit.h"
#include "pipeline/report/quality_table.h"
#include "pipeline/report/result_file.h"
#include "pipeline/report/verdict.h"
#include "pipeline/report/view_figures.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

using nlohmann::json;

json figure_data(const Figure& figure) {
  return {{"src", data_uri("image/svg+xml", figure.picture.svg())},
          {"caption", figure.caption},
          {"alt", figure.alt},
          {"width", std::to_string(static_cast<int>(figure.picture.width()))},
          {"height", std::to_string(static_cast<int>(figure.picture.height()))}};
}

/// A row of views at one scale, the tallest as high as the screen allows.
json view_row_data(const std::vector<Figure>& figures) {
  double width = 0, height = 0;
  json list = json::array();
  for (const Figure& figure : figures) {
    json data = figure_data(figure);
    data["native"] = figure.native.empty() ? "" : data_uri("image/jpeg", figure.native);
    for (const Layer& layer : figure.layers)
      data["layers"].push_back(
          {{"name", layer.name},
           {"src", data_uri("image/svg+xml", layer.picture.svg(Ground::clear))}});
    list.push_back(data);
    width += figure.picture.width();
    height = std::max(height, figure.picture.height());
  }
  return {
      {"figures", list}, {"width", word::number(width, 0)}, {"height", word::number(height, 0)}};
}

/// Pictures of what the segmentation doubts, where it says where.
void add_doubts(const PatientResults& results, json& page) {
  page["doubts"] = json::array();
  const json* sidecar = results.sidecar("segmentation.seg.nrrd");
  if (!sidecar) return;
  for (const json& doubt : sidecar->value(json::json_pointer("/quality/doubts"), json::array()))
    if (const auto figure = doubt_figure(results, doubt))
      page["doubts"].push_back(figure_data(*figure));
}

/// The series that the MRI was chosen of, and why.
void add_series(const PatientResults& results, json& page) {
  page["series"] = json::array();
  page["has_series"] = false;
  const json* sidecar = results.sidecar("segmentation.seg.nrrd");
  if (!sidecar) return;
  const auto shown = [](const json& value, int decimals) {
    return value.is_number() ? word::number(value.get<double>(), decimals) : std::string();
  };
  for (const json& row : sidecar->value(json::json_pointer("/quality/series"), json::array()))
    page["series"].push_back(
        {{"number", row["series"]},
         {"slices", row["slices"].dump()},
         {"voxel", shown(row["voxel_mm"][0], 2) + " × " + shown(row["voxel_mm"][1], 2) + " × " +
                       shown(row["voxel_mm"][2], 2)},
         {"covers", shown(row["covers_mm"], 0)},
         {"seconds", shown(row["seconds_after_first"], 0)},
         {"signal", shown(row["signal_to_noise"], 0)},
         {"skin", shown(row["skin_over_fat"], 2)},
         {"reason", (row["read"].get<bool>() ? "read: " : "") + row["reason"].get<std::string>()}});
  page["has_series"] = !page["series"].empty();
}

void add_mri(const PatientResults& results, json& page) {
  page["mri"] = json::array();
  if (results.segmentation)
    for (const Landmark& lesion : results.lesions())
      page["mri"].push_back(figure_data(mri_figure(results, lesion)));
  page["has_mri"] = !page["mri"].empty() || results.segmentation.has_value();
  page["has_volume"] = results.segmentation.has_value();
  if (page["has_volume"]) page["volume"] = volume_data(results).dump();
}

void add_views(const PatientResults& results, json& page) {
  for (const char* list : {"hung", "simulated", "renders", "cuts", "course"})
    page[list] = json::array();
  page["has_views"] = results.prone && !results.views.empty();
  page["has_scene"] = page["has_views"];
  if (!page["has_views"]) return;
  page["scene"] = scene_data(results).dump();
  for (const BreastShape& shape : breast_shapes(results))
    page["renders"].push_back(figure_data(render_figure(results, shape)));
  std::vector<Figure> hung, simulated;  // own mammograms hang in front
  std::vector<const ViewResult*> of_view;
  for (const ViewResult& view : results.views) {
    std::vector<Figure> figures = detector_figures(results, view);
    if (figures.size() > 1) {
      simulated.push_back(std::move(figures.back()));
      figures.pop_back();
    }
    of_view.insert(of_view.end(), figures.size(), &view);
    std::move(figures.begin(), figures.end(), std::back_inserter(hung));
    for (const Landmark& lesion : results.lesions())
      page["cuts"].push_back(figure_data(compressed_figure(results, view, lesion)));
  }
  const json views = views_data(results, hung, of_view);
  page["hung"].push_back(view_row_data(hung));
  for (std::size_t v = 0; v < hung.size(); ++v)
    page["hung"].back()["figures"][v]["view"] = views["views"][v]["name"];
  page["views"] = views.dump();
  page["carry"] = carry_data(results).dump();
  if (!simulated.empty()) page["simulated"].push_back(view_row_data(simulated));
  if (const auto figure = force_figure(results)) page["course"].push_back(figure_data(*figure));
  if (const auto figure = convergence_figure(results))
    page["course"].push_back(figure_data(*figure));
  page["has_course"] = !page["course"].empty();
}

void add_lesions(const PatientResults& results, json& page) {
  page["answer"] = answer_data(results);
  page["accuracy"] = kAccuracyWords;
  page["supine_accuracy"] = kSupineWords;
  page["what_if_accuracy"] = what_if_words();
  page["lesions"] = lesion_data(results.rows);
  page["has_rows"] = !results.rows.empty();
  page["has_ellipses"] =
      std::any_of(results.rows.begin(), results.rows.end(),
                  [](const LesionRow& row) { return row.ellipse_major_mm.has_value(); });
  page["has_findings"] =
      std::any_of(results.mammograms.begin(), results.mammograms.end(),
                  [](const RealMammogram& real) { return real.findings.has_value(); });
  page["frames"] = figure_data(frames_figure());
}

json quality_row(const std::string& product, const QualityFigure& figure, const json& quality) {
  const auto expected = expectation(product, figure.key, quality);
  return {{"name", figure.name},
          {"value", figure.value},
          {"unit", figure.unit},
          {"expected", expected ? expected->words : ""},
          {"held", expected ? expected->held ? "ok" : "look" : ""}};
}

void add_quality(const PatientResults& results, json& page) {
  page["quality"] = json::array();
  for (const StageRecord& stage : results.stages) {
    const json quality = stage.sidecar.value("quality", json::object());
    json figures = json::array();
    for (const QualityFigure& f : quality_figures(quality))
      figures.push_back(quality_row(stage.product, f, quality));
    std::stable_partition(figures.begin(), figures.end(),
                          [](const json& row) { return row["expected"] != ""; });
    if (!figures.empty())
      page["quality"].push_back({{"product", stage.product}, {"figures", figures}});
  }
}

void add_fit(const PatientResults& results, json& page) {
  page["fit"] = json::array();
  if (const auto figure = fit_figure(results)) page["fit"].push_back(figure_data(*figure));
  if (const auto figure = fit_course_figure(results)) page["fit"].push_back(figure_data(*figure));
}

/// Links to the files beside the page.
void add_files(const PatientResults& results, json& page) {
  page["files"] = json::array();
  for (const std::string& name : results.files)
    if (const std::string words = described_file(name); !words.empty())
      page["files"].push_back({{"file", name}, {"words", words}});
  page["has_files"] = !page["files"].empty();
}

/// The fit in a sentence, from the figures that every fit reports.
std::string fit_summary(const PatientResults& results) {
  const json* sidecar = results.sidecar("prone.vtu");
  const json quality = sidecar ? sidecar->value("quality", json::object()) : json::object();
  const auto has = [&](const char* key) {
    return quality.contains(key) && quality[key].is_number();
  };
  for (const char* key : {"skin_rms_mesh_to_data_mm", "skin_rms_data_to_mesh_mm", "skin_p95_mm",
                          "skin_max_mm", "chest_wall_rms_mm"})
    if (!has(key)) return "";
  const auto mm = [&](const char* key) { return word::number(quality[key], 2) + " mm"; };
  return "The mesh lies " + mm("skin_rms_mesh_to_data_mm") + " RMS from the skin (" +
         mm("skin_rms_data_to_mesh_mm") + " the other way round; 95 % within " + mm("skin_p95_mm") +
         ", at most " + mm("skin_max_mm") + ") and " + mm("chest_wall_rms_mm") +
         " RMS from the chest wall.";
}

/// How the breast hung when imaged, in a sentence: sag and strain are for a person to judge.
std::string unload_summary(const PatientResults& results) {
  const json* sidecar = results.sidecar("unloaded.vtu");
  const json quality = sidecar ? sidecar->value("quality", json::object()) : json::object();
  if (quality.value("gravity", "") == "none")
    return "Gravity was not taken off: the imaged shape counts as free of stress.";
  for (const char* key : {"sag_max_mm", "stretch_p95", "stiffness_factor", "gravity_factor"})
    if (!quality.contains(key) || !quality[key].is_number()) return "";
  if (quality["gravity_factor"] < 1) return "";
  return "Imaged " + quality.value("gravity", "") + ", the breast sags by up to " +
         word::number(quality["sag_max_mm"], 1) +
         " mm from its shape free of stress; 95 % of it is "
         "stretched by less than " +
         word::number(100 * (quality["stretch_p95"].get<double>() - 1), 0) +
         " %. All stiffnesses are " + word::number(quality["stiffness_factor"], 2) +
         " times those given" +
         (quality.contains("stiffness_fit") ? ", fitted to a second state." : ".");
}

json parameter_rows(const json& parameters) {
  json rows = json::array();
  for (const auto& [name, parameter] : parameters.items()) {
    const bool with_unit = parameter.is_object() && parameter.contains("value");
    rows.push_back({{"name", name},
                    {"value", shown_value(with_unit ? parameter["value"] : parameter)},
                    {"unit", with_unit ? parameter.value("unit", "") : ""}});
  }
  return rows;
}

void add_provenance(const PatientResults& results, json& page) {
  page["provenance"] = json::array();
  for (const StageRecord& stage : results.stages) {
    const json& s = stage.sidecar;
    json inputs = json::array();
    for (const json& input : s.value("inputs", json::array()))
      inputs.push_back({{"file", input.value("path", input.value("role", ""))},
                        {"sha256", input.value("sha256", "")}});
    page["provenance"].push_back(
        {{"product", stage.product},
         {"stage", s.value("stage", "")},
         {"version", s.value("version", "")},
         {"command", s.value("command", "")},
         {"parameters", parameter_rows(s.value("parameters", json::object()))},
         {"inputs", inputs}});
  }
  page["notes"] = json::array();
  for (const std::string& note : results.notes) page["notes"].push_back({{"text", note}});
}

}  // namespace

json page_data(const PatientResults& results, const std::string& version) {
  json page = verdict_data(results);
  page["patient"] = results.patient;
  page["version"] = version;
  page["side"] = !results.segmentation                             ? ""
                 : results.segmentation->region.side == Side::left ? "left"
                                                                   : "right";
  page["fit_summary"] = fit_summary(results);
  page["unload_summary"] = unload_summary(results);
  add_lesions(results, page);
  add_views(results, page);
  add_doubts(results, page);
  add_series(results, page);
  add_mri(results, page);
  add_fit(results, page);
  add_quality(results, page);
  add_provenance(results, page);
  add_files(results, page);
  page["has_lesions"] = page["has_rows"] || page["has_views"];
  page["has_fit"] =
      !page["fit"].empty() || page["fit_summary"] != "" || page["unload_summary"] != "";
  return page;
}

}  // namespace mammotwin
