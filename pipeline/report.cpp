// report: everything in a results folder -> one page to look at.

#include "pipeline/report/report.h"

#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/registered_record.h"
#include "pipeline/steps/view_header.h"
#include "registration/mammogram/mammogram_pixels.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path results, page;
  bool picture = false;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.command()
      .option("results", args.results, "folder with a patient's results")
      .required()
      .existing_folder();
  stage.product("page", args.page, "page to write (.html)");
  stage.command().flag("--picture", args.picture,
                       "write the figures as picture.png beside it, too");
}

/// A scene for 3D Slicer and series for ParaView repeat what the page shows.
bool is_made_on_request(const std::string& name) {
  return name.starts_with("scene") || name.find("_course") != std::string::npos ||
         name == "picture.png";
}

bool is_input(const std::filesystem::path& file, const std::filesystem::path& page) {
  const std::string name = file.filename().string();
  return name.front() != '.' && !is_made_on_request(name) &&
         !name.starts_with(page.filename().string());
}

constexpr const char* kViews[] = {"cc", "mlo"};

/// Whatever the folder holds, but for the page itself; and the mammograms that it is shown on.
StagePlan plan(const Arguments& args, const Patient& patient) {
  StagePlan plan{{}, {"views."}};
  for (const char* view : kViews)
    if (const auto& file = patient.view(view).mammogram;
        file && std::filesystem::exists(patient.resolve(*file)))
      plan.inputs.push_back(patient.resolve(*file));
  for (const auto& entry : std::filesystem::directory_iterator(args.results))
    if (entry.is_regular_file() && is_input(entry.path(), args.page))
      plan.inputs.push_back(entry.path());
  std::sort(plan.inputs.begin(), plan.inputs.end());
  return plan;
}

/// What the search was told, found again; nothing where the image shows none.
std::optional<MammogramFindings> findings_of(const Patient& patient, const RealMammogram& real,
                                             double angle_deg) {
  try {
    return find_breast(real.image, real.detector.pixels->spacing_mm, is_oblique(angle_deg),
                       said_in(patient, patient.view(real.view)));
  } catch (const std::runtime_error&) {  // register has said why
    return std::nullopt;
  }
}

RealMammogram real_mammogram(const Patient& patient, const CompressedView& view,
                             const std::vector<LesionRow>& rows) {
  std::vector<std::string> remarks;  // register has said them
  const std::filesystem::path path = patient.resolve(*patient.view(view.name).mammogram);
  RealMammogram real{
      view.name, read_mammogram(path),
      with_header(patient, view.name, view.side, remarks).detector(view.name, view.side)};
  if (!real.detector.pixels) throw std::runtime_error("its pixel spacing is not known");
  real.findings = findings_of(patient, real, view.angle_deg);
  if (const auto& slices = real.detector.slices)
    for (const LesionRow& row : rows)
      if (row.view == view.name && row.slice) {
        const int slice = slices->nearest(*row.slice);
        real.slices.emplace(slice, read_mammogram_slice(path, slice));
      }
  return real;
}

/// Grey values only: nothing of a header comes to the page.
void add_mammograms(const Patient& patient, PatientResults& results) {
  for (const ViewResult& view : results.views) {
    if (!patient.view(view.view.name).mammogram) continue;
    try {
      results.mammograms.push_back(real_mammogram(patient, view.view, results.rows));
    } catch (const std::exception& error) {
      results.notes.push_back("the mammogram of " + view.view.name +
                              " is not shown: " + error.what());
    }
  }
}

/// What `register` left beside a view's shape; of another file there is none.
void add_uncertainties(PatientResults& results) {
  for (ViewResult& view : results.views) try {
      RegisteredRecord record = read_registered(view.file, view.view.name + "_registered.vtu");
      view.uncertainty = std::move(record.uncertainty);
      view.what_if = std::move(record.what_if);
    } catch (const std::exception& error) {
      results.notes.push_back("no sliders for " + view.view.name + ": " + error.what());
    }
}

Outcome run(const Arguments& args, const Patient& patient, StageRun& stage) {
  stage.progress(0, "drawing");
  PatientResults results = read_patient_results(args.results);
  add_uncertainties(results);
  add_mammograms(patient, results);
  write_report(results, stage.products.write_main(), MAMMOTWIN_VERSION);
  if (args.picture) write_report_picture(results, stage.products.write("picture.png"));
  return {};
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "report", "everything in a results folder -> one page to look at",
                   declare, plan, run);
}
