// slicer: everything in a results folder -> a scene that 3D Slicer opens with all in place.

#include <fstream>

#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/slicer/scene.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path results, scene;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.command()
      .option("results", args.results, "folder with a patient's results")
      .required()
      .existing_folder();
  stage.product("scene", args.scene,
                "scene to write in that folder (.mrml; scene_*.vtp beside it)");
}

/// The products of the stages before it; pages, sidecars and load steps are not in the scene.
bool is_input(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const auto ends = [&](const char* end) { return name.ends_with(end); };
  return name.front() != '.' && name.rfind("scene", 0) != 0 &&
         name.find("_course_") == std::string::npos &&
         (ends(".nrrd") || ends(".vtu") || ends(".mrk.json") || name == "lesions.csv");
}

StagePlan plan(const Arguments& args, const Patient&) {
  StagePlan plan;
  for (const auto& entry : std::filesystem::directory_iterator(args.results))
    if (entry.is_regular_file() && is_input(entry.path())) plan.inputs.push_back(entry.path());
  std::sort(plan.inputs.begin(), plan.inputs.end());
  return plan;
}

Outcome run(const Arguments& args, const Patient&, StageRun& stage) {
  stage.progress(0, "writing surfaces");
  const std::string scene =
      slicer_scene(read_patient_results(args.results),
                   [&](const std::string& name) { return stage.products.write(name); });
  std::ofstream(stage.products.write_main()) << scene;
  return {};
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "slicer", "everything in a results folder -> a scene for 3D Slicer",
                   declare, plan, run);
}
