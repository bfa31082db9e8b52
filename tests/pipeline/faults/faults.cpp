#include "tests/pipeline/faults/faults.h"

#include <sys/stat.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::uintmax_t inode_of(const fs::path& path) {
  struct stat info {};
  return lstat(path.c_str(), &info) == 0 ? info.st_ino : 0;
}

std::string entries_of(const fs::path& folder) {
  std::ostringstream lines;
  for (const auto& entry : fs::directory_iterator(folder))
    lines << inode_of(entry.path()) << (entry.is_directory() ? " d " : " f ")
          << entry.path().filename().string() << "\n";
  return lines.str();
}

}  // namespace

Faults::Faults(fs::path folder, const fs::path& scratch, Keeps keeps)
    : folder_(std::move(folder)),
      store_(scratch / "store"),
      counter_(scratch / "counter"),
      keeps_(keeps) {
  fs::create_directories(store_);
}

CommandResult Faults::run(const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment, long kill_at,
                          long every_write) {
  fs::remove_all(store_);
  fs::create_directories(store_);
  if (keeps_ == Keeps::what_was_synced) remember(folder_);
  put(counter_, std::string(sizeof(FolderSteps), '\0'));
  std::vector<std::string> all = environment;
  for (const std::string& entry :
       {std::string("LD_PRELOAD=" MAMMOTWIN_BIN "/libmammotwin_fault_layer.so"),
        "FAULT_FOLDER=" + folder_.string(),
        "FAULT_STORE=" + (keeps_ == Keeps::nothing ? std::string() : store_.string()),
        "FAULT_COUNTER=" + counter_.string(), "FAULT_KILL_AT=" + std::to_string(kill_at),
        "FAULT_EVERY_WRITE=" + std::to_string(every_write)})
    all.push_back(entry);
  return run_command_in_group(arguments, all);
}

FolderSteps Faults::steps() const {
  const std::string bytes = bytes_of(counter_);
  FolderSteps steps;
  std::memcpy(&steps, bytes.data(), sizeof steps);
  return steps;
}

void Faults::cut_power(AfterPowerCut what) {
  const fs::path left = folder_.string() + ".left";
  fs::remove_all(left);
  restore(folder_, inode_of(folder_), left, what);
  fs::remove_all(folder_);
  fs::rename(left, folder_);
}

void Faults::remember(const fs::path& folder) {
  put(stored("entries", inode_of(folder)), entries_of(folder));
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory())
      remember(entry.path());
    else
      put(stored("content", inode_of(entry.path())), bytes_of(entry.path()));
}

/// `from`: the folder as it is seen, where it is still there.
void Faults::restore(const fs::path& from, std::uintmax_t inode, const fs::path& to,
                     AfterPowerCut what) const {
  fs::create_directories(to);
  std::istringstream lines(what == AfterPowerCut::entries_as_seen && fs::is_directory(from)
                               ? entries_of(from)
                               : bytes_of(stored("entries", inode)));
  std::uintmax_t entry = 0;
  std::string kind, name;
  while (lines >> entry >> kind && std::getline(lines >> std::ws, name))
    if (kind == "d")
      restore(from / name, entry, to / name, what);
    else
      put(to / name, bytes_of(stored("content", entry)));
}

std::string Faults::stored(const char* what, std::uintmax_t inode) const {
  return (store_ / (std::string(what) + "-" + std::to_string(inode))).string();
}

}  // namespace mammotwin
