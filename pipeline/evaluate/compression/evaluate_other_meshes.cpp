// evaluate-other-meshes: breasts pressed with this program's meshes and with another one's -> one
// table.

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/compression/other_mesh_rows.h"
#include "pipeline/frame/command_line.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path patient, cases, others, table;
  std::vector<std::string> views;
};

void declare(CommandLine& command, Arguments& args) {
  declare_patient(command, args.patient);
  declare_cases(command, args.cases);
  command
      .option(
          "others", args.others,
          "folder of meshes of the same segmentations: 042/prone.vtu, Exam_02-left/prone.vtu, ...")
      .required()
      .existing_folder();
  declare_table(command, args.table, "other_meshes");
  declare_views(command, args.views);
}

int run(const Arguments& args) {
  EvaluationTable table(args.table);
  std::size_t breasts = 0;
  for (const BreastToPress& breast :
       breasts_to_press(args.patient, args.cases, {}, table.folder() / "other_meshes")) {
    OtherMesh other{fs::absolute(args.others) / breast.name / "prone.vtu"};
    if (!fs::exists(other.mesh)) continue;
    if (!args.views.empty()) other.views = args.views;
    add_other_mesh_rows(breast, other, [&](const nlohmann::json& row) { table.add(breasts, row); });
    ++breasts;
  }
  if (breasts == 0)
    throw std::runtime_error(args.others.string() +
                             ": holds no mesh that is named for one of the breasts "
                             "(such as Exam_02-left/prone.vtu)");
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "evaluate-other-meshes",
      "Presses breasts with this program's meshes and with another one's, and writes how far apart "
      "lesions come to lie",
      declare, run);
}
