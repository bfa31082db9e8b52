#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/frame/command_line.h"

namespace mammotwin {

// Arguments that evaluations share, in the order of their positionals.

void declare_patient(CommandLine& command, std::filesystem::path& patient);
void declare_cases(CommandLine& command, std::filesystem::path& cases);
/// NAME.json; `whose` files go to the folder NAME beside it.
void declare_table(CommandLine& command, std::filesystem::path& table, const std::string& name,
                   const std::string& whose = "each breast's");
void declare_only(CommandLine& command, std::vector<std::string>& only);
/// Is it one of those that --only names, by parts of their names? All are where it names none.
bool is_asked(const std::string& name, const std::vector<std::string>& only);
/// Rows of other breasts that the table has already stay (EvaluationTable).
void declare_keep(CommandLine& command, bool& keep);
void declare_views(CommandLine& command, std::vector<std::string>& views);
void declare_unloaded(CommandLine& command, bool& unload);
/// How many run at once, as many as `jobs` says where it is not given.
void declare_jobs(CommandLine& command, int& jobs, const std::string& what = "breasts at a time");

}  // namespace mammotwin
