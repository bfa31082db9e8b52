#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mammotwin {

/// The table of an evaluation, {"cases": [row...]}: whole on disk after each row, so that one that
/// is broken off keeps what it has. Rows may come from several threads.
class EvaluationTable {
 public:
  /// Makes the folder of `file`. `keep`: the rows of other breasts (`name`, `side`) that are there
  /// already stay, before those that are added. Throws std::filesystem::filesystem_error where it
  /// cannot make it, std::runtime_error naming the file where what it is to keep is no table.
  explicit EvaluationTable(const std::filesystem::path& file, bool keep = false);

  const std::filesystem::path& folder() const { return folder_; }  ///< absolute

  /// A row of case `number` (from 0), and what is said of it on standard error. Rows stand in the
  /// order of their cases.
  void add(std::size_t number, nlohmann::json row, const std::string& said);
  /// The same, said as it is.
  void add(std::size_t number, nlohmann::json row);

  nlohmann::json rows() const;

 private:
  nlohmann::json all() const;

  std::filesystem::path file_, folder_;
  std::vector<nlohmann::json> kept_;
  std::vector<std::vector<nlohmann::json>> rows_;  // of each case
  mutable std::mutex mutex_;
};

/// Calls `one` with 0 to `cases` - 1 on `jobs` threads. The first exception ends it after the calls
/// that have begun, and is thrown on.
void work_through(std::size_t cases, int jobs, const std::function<void(std::size_t)>& one);

}  // namespace mammotwin
