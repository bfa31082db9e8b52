#include "pipeline/report/patient_results.h"

#include <cctype>

#include "registration/search/search_verdict.h"

namespace mammotwin {
namespace {

/// Of a view whose search ended so, what follows `prefix` in the first of its reasons that has it;
/// empty where it ended otherwise.
std::string first_reason(const PatientResults& results, const std::string& view, SearchEnd end,
                         const std::string& prefix) {
  const nlohmann::json* lesions = results.sidecar("lesions.csv");
  if (!lesions || !lesions->contains("quality")) return "";
  const nlohmann::json search = lesions->at("quality").value("search", nlohmann::json());
  if (!search.is_object() || !search.contains(view)) return "";
  if (search.at(view).value("end", "") != name_of(end)) return "";
  for (const std::string& reason : search.at(view).value("reasons", std::vector<std::string>()))
    if (const std::size_t at = reason.find(prefix); at != std::string::npos)
      return reason.substr(at + prefix.size());
  return "see the remarks";
}

}  // namespace

std::string title_of_view(const std::string& name) {
  std::string title = name;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return title;
}

std::vector<Landmark> PatientResults::lesions() const {
  std::vector<Landmark> found;
  if (segmentation)
    for (const Lesion& lesion : segmentation->lesions)
      found.push_back({lesion.id, lesion.centroid_in_lps});
  if (!found.empty()) return found;
  for (const LesionRow& row : rows)
    if (row.view == "mri")
      found.push_back({row.lesion, {*row.mri_l_mm, *row.mri_p_mm, *row.mri_s_mm}});
  return found;
}

std::optional<Eigen::Vector3d> PatientResults::nipple() const {
  if (segmentation) return segmentation->nipple_in_lps;
  return std::nullopt;
}

const ViewResult* PatientResults::view(const std::string& name) const {
  for (const ViewResult& view : views)
    if (view.view.name == name) return &view;
  return nullptr;
}

const RealMammogram* PatientResults::mammogram(const std::string& view) const {
  for (const RealMammogram& real : mammograms)
    if (real.view == view) return &real;
  return nullptr;
}

const nlohmann::json* PatientResults::sidecar(const std::string& product) const {
  for (const StageRecord& stage : stages)
    if (stage.product == product) return &stage.sidecar;
  return nullptr;
}

std::string PatientResults::not_registered(const std::string& view) const {
  const std::string end = name_of(SearchEnd::no_registration);
  return first_reason(*this, view, SearchEnd::no_registration, end + ": ");
}

std::string PatientResults::registered_in_doubt(const std::string& view) const {
  return first_reason(*this, view, SearchEnd::look, view + ": ");
}

}  // namespace mammotwin
