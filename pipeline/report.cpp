// report: everything in a results folder -> one page to look at.

#include "pipeline/report/report.h"

#include "pipeline/frame/stage.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path results, page;
  bool picture = false;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.app().add_option("results", args.results, "folder with a patient's results")
      ->required()
      ->check(CLI::ExistingDirectory);
  stage.product("page", args.page, "page to write (.html)");
  stage.app().add_flag("--picture", args.picture, "write the figures as picture.png beside it, too");
}

bool is_input(const std::filesystem::path& file, const std::filesystem::path& page) {
  const std::string name = file.filename().string();
  return name.front() != '.' && name != "picture.png" && name.rfind(page.filename().string(), 0) != 0;
}

/// Whatever the folder holds, but for the page itself.
StagePlan plan(const Arguments& args, const Patient&) {
  StagePlan plan;
  for (const auto& entry : std::filesystem::directory_iterator(args.results))
    if (entry.is_regular_file() && is_input(entry.path(), args.page))
      plan.inputs.push_back(entry.path());
  std::sort(plan.inputs.begin(), plan.inputs.end());
  return plan;
}

Outcome run(const Arguments& args, StageRun& stage) {
  stage.progress(0, "drawing");
  write_report(args.results, stage.products.write_main(), MAMMOTWIN_VERSION);
  if (args.picture) write_report_picture(args.results, stage.products.write("picture.png"));
  return {};
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "report", "everything in a results folder -> one page to look at",
                   declare, plan, run);
}
