#pragma once

#include <filesystem>
#include <string>

namespace mammotwin {

class PrivateNames;

/// Call first in `main`. OpenBLAS reads its settings when it is loaded, so this sets them (one
/// thread; the kernels of this processor, where the user has not chosen) and starts the program
/// again if they were not set. Returns only in the program that is to go on. A program that calls
/// it also does so before its libraries begin.
void prepare_process(char** argv);

/// Largest resident size of this process so far [MB].
double peak_memory_mb();

/// The command line with the paths in it made relative to `folder`; where `names` are given, those
/// outside it with their roles, or as "file".
std::string command_text(int argc, char** argv, const std::filesystem::path& folder,
                         const PrivateNames* names);

}  // namespace mammotwin
