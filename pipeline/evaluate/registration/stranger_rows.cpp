#include "pipeline/evaluate/registration/stranger_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/breast_stages.h"
#include "pipeline/frame/outcome.h"
#include "pipeline/frame/products.h"
#include "registration/search/search_verdict.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The breast's folder with both compressions in it.
BreastToPress pressed_in(const RealBreast& breast, const fs::path& folder) {
  fs::create_directories(folder);
  BreastToPress pressed{name_and_side(breast), folder / "patient.toml", folder};
  write_text_atomically(pressed.patient_toml, patient_toml_of(breast));
  const BreastStages stages(pressed);
  stages.fit(folder / "prone.vtu");
  stages.unload(folder / "prone.vtu", folder / "unloaded.vtu");
  for (const std::string view : {"cc", "mlo"})
    stages.press(view, folder / "unloaded.vtu", folder / (view + ".vtu"));
  return pressed;
}

std::vector<std::string> mammogram_options(const ReadMammogram& mammogram) {
  const std::string key = "--views-" + mammogram.view;
  return {key + "-mammogram", mammogram.file.string(), key + "-detector-pixel-spacing-mm",
          std::to_string(mammogram.pixel_mm)};
}

/// The sidecar of lesions.csv, in `folder`; one of status refused where register took none of it.
json register_exam(const BreastToPress& pressed, const StrangersExam& exam,
                   const fs::path& folder) {
  fs::create_directories(folder);
  const auto in = [&](const char* file) { return (pressed.folder / file).string(); };
  ProductRun run{"register",
                 {in("segmentation.seg.nrrd"), in("fractions.nrrd"), in("cc.vtu"), in("mlo.vtu")},
                 folder / "lesions.csv",
                 pressed.patient_toml};
  for (const ReadMammogram* mammogram : {&exam.cc, &exam.mlo})
    for (const std::string& option : mammogram_options(*mammogram)) run.options.push_back(option);
  try {
    run_to_product(run);
  } catch (const std::runtime_error& error) {
    const json said = stage_sidecar(run.product);
    if (!said.is_object() || said.at("status") != name_of(Status::refused)) throw;
  }
  return stage_sidecar(run.product);
}

json view_row(const ReadMammogram& mammogram, const json& said) {
  const json search = said.at("quality").value("search", json::object());
  const std::string status = said.at("status");
  json row{{"view", mammogram.view},
           {"file", mammogram.file.filename().string()},
           {"status", status},
           {"search", search.value(mammogram.view, json())}};
  row["end"] = status == name_of(Status::refused) ? json("refused")
               : row["search"].is_object()        ? row["search"].value("end", json("none"))
                                                  : json("none");
  row["noticed"] = row["end"] != name_of(SearchEnd::ok) && row["end"] != name_of(SearchEnd::look);
  return row;
}

}  // namespace

std::vector<StrangersExam> strangers_exams(const std::vector<ReadMammogram>& mammograms,
                                           Side side) {
  std::vector<const ReadMammogram*> cc, mlo;
  for (const ReadMammogram& mammogram : mammograms)
    if (mammogram.wall_at_left == (side == Side::left))
      (mammogram.oblique() ? mlo : cc).push_back(&mammogram);
  std::vector<StrangersExam> exams;
  for (const ReadMammogram* one : cc) {
    const auto other = std::find_if(mlo.begin(), mlo.end(), [&](const ReadMammogram* m) {
      return m->pixel_mm == one->pixel_mm;
    });
    if (other == mlo.end()) continue;
    exams.push_back({*one, **other});
    mlo.erase(other);
  }
  return exams;
}

void add_stranger_rows(const RealBreast& breast, const std::vector<StrangersExam>& exams,
                       const fs::path& folder, const std::function<void(const json&)>& add) {
  const json about{{"name", breast.name}, {"side", name_of(breast.side)}};
  const auto failed = [&](const std::exception& error, json row) {
    row["reason"] = error.what();
    add(row);
  };
  BreastToPress pressed;
  try {
    pressed = pressed_in(breast, folder);
  } catch (const std::exception& error) {
    return failed(error, about);
  }
  for (std::size_t n = 0; n < exams.size(); ++n) {
    json row = about;
    const std::string exam = "exam_" + std::to_string(n + 1);
    row["exam"] = exam;
    try {
      const json said = register_exam(pressed, exams[n], folder / exam);
      for (const ReadMammogram* mammogram : {&exams[n].cc, &exams[n].mlo}) {
        row.update(view_row(*mammogram, said));
        add(row);
      }
    } catch (const std::exception& error) {
      failed(error, row);
    }
  }
}

}  // namespace mammotwin
