#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/pipeline/command.h"

namespace mammotwin {

/// What of a folder a loss of power leaves.
enum class AfterPowerCut {
  entries_as_synced,  ///< names as they were at their folder's last fsync
  entries_as_seen,    ///< names as programs saw them last, as file systems may have written them
};

/// What was done in a watched folder: files opened for writing, written, closed, renamed, removed,
/// new folders, fsync.
struct FolderSteps {
  long all = 0;
  long writes = 0;  ///< of these
};

/// Runs programs over the fault layer (fault_layer.cpp), in a group of their own.
class Faults {
 public:
  enum class Keeps { nothing, what_was_synced };

  /// `folder`: watched; must be there. `scratch`: for the layer's own files.
  Faults(std::filesystem::path folder, const std::filesystem::path& scratch,
         Keeps keeps = Keeps::what_was_synced);

  /// Kills all before step `kill_at` in the folder, of whose writes every `every_write`-th counts;
  /// 0: never. The exit code is 137 where it did.
  CommandResult run(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment, long kill_at = 0,
                    long every_write = 1);

  /// Steps that counted in the folder during the last run, and writes, all of them.
  FolderSteps steps() const;

  /// What was in the folder when the last run began counts as written to the disk; since then, a
  /// file's bytes and a folder's entries only at an fsync of it. Puts that into the folder.
  void cut_power(AfterPowerCut what);

 private:
  void remember(const std::filesystem::path& folder);
  void restore(const std::filesystem::path& from, std::uintmax_t inode,
               const std::filesystem::path& to, AfterPowerCut what) const;
  std::string stored(const char* what, std::uintmax_t inode) const;

  std::filesystem::path folder_, store_, counter_;
  Keeps keeps_;
};

}  // namespace mammotwin
