// paraview: a compressed mesh -> the breast after each load step, as a series that ParaView plays.

#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/compression_course.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path compressed, collection;
};

void declare(StageDeclaration& stage, Arguments& args) {
  stage.input("compressed", args.compressed, "compressed mesh from compress (.vtu)");
  stage.product("collection", args.collection,
                "series to write (.pvd; its meshes <name>_00.vtu and so on beside it)");
}

StagePlan plan(const Arguments&, const Patient&) { return {}; }

Outcome run(const Arguments& args, const Patient&, StageRun& stage) {
  const MeshFile compressed = read_mesh_file(args.compressed);
  const std::vector<CourseStep> course = course_of(compressed);
  if (course.empty())
    throw std::runtime_error(args.compressed.string() +
                             ": holds no load steps; run compress again (FORCE=1)");
  write_course(compressed, course, args.collection.stem().string(), stage.products.write_main(),
               [&](const std::string& name) { return stage.products.write(name); });
  Outcome outcome;
  outcome.quality = {{"steps", course.size() - 1}};
  return outcome;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_stage(argc, argv, "paraview",
                   "a compressed mesh -> the breast after each load step, for ParaView", declare,
                   plan, run);
}
