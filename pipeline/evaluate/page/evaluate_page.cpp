// evaluate-page: pages in Chromium -> how soon they open and how fast they follow the sliders.

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/sorted_figures.h"
#include "pipeline/evaluate/page/browser.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Arguments {
  std::vector<std::string> pages;
  fs::path table;
  std::optional<fs::path> axe;
  int runs = 5;
};

void declare(CommandLine& command, Arguments& args) {
  declare_table(command, args.table, "page", "the browser's own");
  command.option("pages", args.pages, "report.html, one or more").required().existing_file();
  command.option("--axe", args.axe, "axe.min.js of axe-core: the page is checked by it, too")
      .existing_file();
  command.option("--runs", args.runs, "of each page, each in a browser of its own")
      .between(1, 1000)
      .with_default();
}

constexpr int kFrames = 120;

/// Moves all sliders at once, to and fro, before each frame that is drawn: milliseconds a frame, of
/// the page's own script in each, and how many were drawn.
const char* const kMoveSliders = R"js((async () => {
  const form = document.getElementById("what-if"), sliders = [...form.querySelectorAll("input[type=range]")];
  const before = Number(form.dataset.frames || 0), script = [], now = () => performance.now();
  const start = now();
  for (let frame = 1; frame <= FRAMES; ++frame) {
    let began = 0, input = now();
    requestAnimationFrame(() => { began = now(); });
    for (const slider of sliders) {
      slider.value = slider.max * Math.sin(frame / 10);
      slider.dispatchEvent(new Event("input"));
    }
    input = now() - input;
    await new Promise(done => requestAnimationFrame(() => { script.push(input + now() - began); done(); }));
  }
  return { sliders: sliders.length, took_ms: now() - start, script_ms: script,
           drawn: Number(form.dataset.frames || 0) - before };
})())js";

std::string with_frames(std::string script) {
  const std::string word = "FRAMES";
  return script.replace(script.find(word), word.size(), std::to_string(kFrames));
}

void add_opening(Browser& browser, const fs::path& page, json& row) {
  const double cpu = browser.cpu_seconds();
  browser.open(fs::absolute(page));
  const std::string paint = "performance.getEntriesByName('first-contentful-paint')[0]";
  browser.wait_until(paint + " && document.getElementById('planes').dataset.ready");
  row["first_picture_s"] = browser.evaluate(paint + ".startTime").get<double>() / 1000;
  row["opening_cpu_s"] = browser.cpu_seconds() - cpu;
}

void add_frames(Browser& browser, json& row) {
  using Clock = std::chrono::steady_clock;
  const double cpu = browser.cpu_seconds();
  const Clock::time_point start = Clock::now();
  const json moved = browser.evaluate(with_frames(kMoveSliders));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (moved.at("sliders") == 0) return;
  const double drawn = moved.at("drawn").get<double>();
  std::vector<double> script = moved.at("script_ms");
  std::sort(script.begin(), script.end());
  row["frames_a_second"] = drawn / (moved.at("took_ms").get<double>() / 1000);
  row["script_ms"] = median_of_sorted(script);
  row["cpu_ms_a_frame"] = 1000 * (browser.cpu_seconds() - cpu) / drawn;
  row["cores_had"] = (browser.cpu_seconds() - cpu) / seconds;
}

/// On the two screens of the report's tests.
void add_violations(Browser& browser, const fs::path& axe, json& row) {
  std::ifstream file(axe);
  browser.evaluate({std::istreambuf_iterator<char>(file), {}});
  std::size_t violations = 0;
  for (const auto& [width, height] : {std::pair(1366, 768), std::pair(390, 844)}) {
    browser.call(
        "Emulation.setDeviceMetricsOverride",
        {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
    const json found = browser.evaluate(
        "axe.run(document, {}).then(r => r.violations.map(v => v.id + ': ' + v.nodes[0].html))");
    for (const json& one : found) std::cerr << width << " px: " << one << std::endl;
    violations += found.size();
  }
  row["axe_violations"] = violations;
}

json row_of(const Arguments& args, const fs::path& page, int run, const fs::path& profile) {
  json row{{"name", fs::absolute(page).parent_path().filename()},
           {"run", run},
           {"megabytes", static_cast<double>(fs::file_size(page)) / 1e6}};
  for (const char* key :
       {"frames_a_second", "script_ms", "cpu_ms_a_frame", "cores_had", "axe_violations"})
    row[key] = nullptr;
  fs::remove_all(profile);
  Browser browser(profile);
  add_opening(browser, page, row);
  add_frames(browser, row);
  if (args.axe) add_violations(browser, *args.axe, row);
  return row;
}

int run(const Arguments& args) {
  if (Browser::program().empty())
    throw std::runtime_error("there is no Chromium (package chromium)");
  EvaluationTable table(args.table);
  for (std::size_t n = 0; n < args.pages.size(); ++n)
    for (int run = 1; run <= args.runs; ++run)
      table.add(n, row_of(args, args.pages[n], run, table.folder() / "page"));
  fs::remove_all(table.folder() / "page");
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-page",
      "Opens pages in Chromium and moves their sliders: when they are seen, frames a second",
      declare, run);
}
