#include "pipeline/evaluate/cases/case_arguments.h"

#include <algorithm>

namespace mammotwin {

namespace fs = std::filesystem;

void declare_patient(CommandLine& command, fs::path& patient) {
  command.option("patient", patient, "patient.toml of a first breast").required().existing_file();
}

void declare_cases(CommandLine& command, fs::path& cases) {
  command.option("cases", cases, "folder with label_maps/*.nii.gz and mimbcd_*/mri")
      .required()
      .existing_folder();
}

void declare_table(CommandLine& command, fs::path& table, const std::string& name,
                   const std::string& whose) {
  command
      .option("table", table,
              name + ".json to write; " + whose + " files go to the folder " + name + " beside it")
      .required();
}

void declare_only(CommandLine& command, std::vector<std::string>& only) {
  command.option("--only", only, "cases whose name (name-side) contains one of these (texts)");
}

bool is_asked(const std::string& name, const std::vector<std::string>& only) {
  return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& part) {
           return name.find(part) != std::string::npos;
         });
}

void declare_keep(CommandLine& command, bool& keep) {
  command.flag("--keep", keep, "rows of other breasts that the table has already stay in it");
}

void declare_views(CommandLine& command, std::vector<std::string>& views) {
  command.option("--views", views, "cc, mlo (default: both)").one_of({"cc", "mlo"});
}

void declare_unloaded(CommandLine& command, bool& unload) {
  command.flag("--unloaded", unload, "press the shape free of gravity, not the imaged one");
}

void declare_jobs(CommandLine& command, int& jobs, const std::string& what) {
  command.option("--jobs", jobs, what + " [1 to 64]").between(1, 64).with_default();
}

}  // namespace mammotwin
