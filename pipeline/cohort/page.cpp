#include "pipeline/cohort/page.h"

#include <algorithm>
#include <array>
#include <map>

#include "pipeline/cohort/distribution.h"
#include "pipeline/cohort/histogram.h"
#include "pipeline/cohort/html_text.h"
#include "pipeline/cohort/page_style.h"

namespace mammotwin {
namespace {

using Cohort = std::vector<PatientSummary>;
constexpr std::size_t kMostOutliersNamed = 12;
constexpr std::size_t kMostOutlyingPatients = 30;

struct StatusText {
  const char* status;
  const char* sign_and_words;
};
/// Worst first, which is the page's order.
constexpr std::array<StatusText, 6> kStatuses{{{"refused", "✖ refused"},
                                               {"not_converged", "✖ not converged"},
                                               {"interrupted", "✖ interrupted"},
                                               {"not_run", "… not run"},
                                               {"look", "▲ look"},
                                               {"ok", "✔ ok"}}};

std::string status_html(const std::string& status) {
  const auto* known = std::find_if(kStatuses.begin(), kStatuses.end(),
                                   [&](const StatusText& s) { return s.status == status; });
  const std::string words = known != kStatuses.end() ? known->sign_and_words : html_text(status);
  return "<span class=\"status " + html_text(status) + "\">" + words + "</span>";
}

std::string link_html(const std::string& address, const std::string& text) {
  return "<a href=\"" + html_text(address) + "\">" + html_text(text) + "</a>";
}

/// Patients' names as links to their pages, where there are any.
class Links {
 public:
  explicit Links(const Cohort& cohort) {
    for (const PatientSummary& p : cohort) has_page_[p.patient] = p.has_page;
  }
  std::string to(const std::string& patient) const {
    return has_page_.at(patient) ? link_html(patient + "/report.html", patient)
                                 : html_text(patient);
  }

 private:
  std::map<std::string, bool> has_page_;
};

std::string table_html(const std::string& caption, const std::vector<std::string>& headings,
                       const std::string& rows) {
  std::string html = "<div class=\"wide\"><table><caption>" + caption + "</caption><thead><tr>";
  for (const std::string& heading : headings) html += "<th scope=\"col\">" + heading + "</th>";
  return html + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string row_html(const std::string& first, const std::vector<std::string>& others) {
  std::string html = "<tr><th scope=\"row\">" + first + "</th>";
  for (const std::string& other : others) html += "<td>" + other + "</td>";
  return html + "</tr>\n";
}

std::string counts_html(const Cohort& cohort) {
  std::string html = "<ul class=\"counts\">\n";
  for (const StatusText& s : kStatuses) {
    const auto count = std::count_if(cohort.begin(), cohort.end(),
                                     [&](const PatientSummary& p) { return p.status == s.status; });
    if (count > 0)
      html += "<li><b>" + std::to_string(count) + "</b> " + status_html(s.status) + "</li>\n";
  }
  return html + "</ul>\n";
}

std::string failures_html(const Cohort& cohort, const Links& links, const RunAgain& again) {
  std::string rows;
  for (const StatusText& s : kStatuses)
    for (const PatientSummary& p : cohort)
      if (p.failed() && p.status == s.status)
        rows += row_html(links.to(p.patient),
                         {status_html(p.status), html_text(p.stage), html_text(joined(p.reasons)),
                          "<code>" + html_text(again.command(p.patient)) + "</code>"});
  const std::string heading = "<h2 id=\"failures\">Failures</h2>\n";
  if (rows.empty()) return heading + "<p>None.</p>\n";
  return heading + table_html("The same list is in " + link_html("failed.tsv", "failed.tsv") +
                                  "; <code>ONLY=failed</code> runs just these again.",
                              {"patient", "status", "at stage", "reason", "run again"}, rows);
}

std::string looks_html(const Cohort& cohort, const Links& links) {
  std::string rows;
  for (const PatientSummary& p : cohort)
    if (p.status == "look") rows += row_html(links.to(p.patient), {html_text(joined(p.reasons))});
  if (rows.empty()) return {};
  return "<h2 id=\"look\">To look at</h2>\n" +
         table_html("Done, but a person should see these first.", {"patient", "why"}, rows);
}

/// Where a point lies in the scanner says nothing of how well a stage did.
bool is_position(const Distribution& d) { return d.name.find("_lps_mm.") != std::string::npos; }

std::string outlier_rows(const std::vector<Distribution>& distributions, const Links& links) {
  std::map<std::string, std::vector<std::string>> figures_by_patient;
  for (const Distribution& d : distributions)
    for (const auto& v : d.outliers())
      figures_by_patient[v.patient].push_back(d.name + " " + short_number(v.value));
  std::vector<std::pair<std::string, std::vector<std::string>>> ordered(figures_by_patient.begin(),
                                                                        figures_by_patient.end());
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  if (ordered.size() > kMostOutlyingPatients) ordered.resize(kMostOutlyingPatients);
  std::string rows;
  for (const auto& [patient, figures] : ordered)
    rows +=
        row_html(links.to(patient), {std::to_string(figures.size()), html_text(joined(figures))});
  return rows;
}

std::string outliers_html(const std::vector<Distribution>& distributions, const Links& links) {
  const std::string rows = outlier_rows(distributions, links);
  if (rows.empty()) return {};
  return "<h2 id=\"outliers\">Outliers</h2>\n" +
         table_html(
             "Figures more than 1.5 interquartile ranges outside the quartiles, for the up to " +
                 std::to_string(kMostOutlyingPatients) +
                 " patients who have most of them; those of others stand below their figures. An "
                 "outlier is a reason to look, not an error.",
             {"patient", "how many", "which"}, rows);
}

std::string outlier_list_html(const Distribution& d, const Links& links) {
  const auto outliers = d.outliers();
  if (outliers.empty()) return {};
  std::string html = "<p>Outliers: ";
  for (std::size_t i = 0; i < std::min(outliers.size(), kMostOutliersNamed); ++i)
    html += (i ? ", " : "") + links.to(outliers[i].patient) + " " + short_number(outliers[i].value);
  if (outliers.size() > kMostOutliersNamed)
    html += " and " + std::to_string(outliers.size() - kMostOutliersNamed) + " more";
  return html + "</p>";
}

std::string figure_html(const Distribution& d, const Links& links) {
  const std::string unit = unit_of(d.name);
  return "<figure><figcaption><code>" + html_text(d.name) + "</code>" +
         (unit.empty() ? "" : " [" + unit + "]") + ", " + std::to_string(d.values.size()) +
         " patients</figcaption>" + histogram_svg(d) + outlier_list_html(d, links) + "</figure>\n";
}

std::string product_html(const std::string& product, const std::vector<Distribution>& its,
                         const Links& links) {
  std::string figures, constants;
  for (const Distribution& d : its)
    if (d.is_constant())
      constants +=
          (constants.empty() ? "" : ", ") + html_text(d.name) + " " + short_number(d.median);
    else
      figures += figure_html(d, links);
  std::string html = "<h3>" + html_text(product) + "</h3>\n";
  if (!constants.empty()) html += "<p class=\"note\">The same for all: " + constants + ".</p>\n";
  return html + "<div class=\"figures\">\n" + figures + "</div>\n";
}

std::string distributions_html(const std::vector<Distribution>& distributions, const Links& links) {
  std::string html =
      "<h2 id=\"distributions\">Distributions</h2>\n<p class=\"note\">Bars count patients; the "
      "band "
      "below them is the middle half, its dark line the median, diamonds are outliers.</p>\n";
  if (distributions.empty()) return html + "<p>No figures yet.</p>\n";
  const auto product_of = [](const Distribution& d) { return d.name.substr(0, d.name.find('.')); };
  for (auto first = distributions.begin(); first != distributions.end();) {
    const std::string product = product_of(*first);
    const auto last = std::find_if(first, distributions.end(),
                                   [&](const Distribution& d) { return product_of(d) != product; });
    html += product_html(product, {first, last}, links);
    first = last;
  }
  return html;
}

std::string everyone_html(const Cohort& cohort, const Links& links) {
  std::string rows;
  for (const PatientSummary& p : cohort)
    rows += row_html(links.to(p.patient), {status_html(p.status), html_text(p.stage)});
  return "<h2 id=\"patients\">All patients</h2>\n" +
         table_html("Every figure of every patient is in " + link_html("cohort.tsv", "cohort.tsv") +
                        ", times and memory in " +
                        link_html("cohort_times.tsv", "cohort_times.tsv") + ".",
                    {"patient", "status", "last stage"}, rows);
}

}  // namespace

std::string cohort_page(const Cohort& cohort, const RunAgain& again) {
  const Links links(cohort);
  std::vector<Distribution> distributions = distributions_of(cohort);
  distributions.erase(std::remove_if(distributions.begin(), distributions.end(), is_position),
                      distributions.end());
  return std::string("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         "<title>Cohort of " + std::to_string(cohort.size()) + " patients</title>\n<style>" +
         kPageStyle + "</style></head><body><main>\n<h1>Cohort of " +
         std::to_string(cohort.size()) + " patients</h1>\n" + counts_html(cohort) +
         failures_html(cohort, links, again) + looks_html(cohort, links) +
         outliers_html(distributions, links) + distributions_html(distributions, links) +
         everyone_html(cohort, links) + "</main></body></html>\n";
}

}  // namespace mammotwin
