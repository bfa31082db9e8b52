#include "pipeline/cohort/verify_results.h"

#include <map>
#include <set>
#include <stdexcept>

#include "pipeline/cohort/stage_result.h"
#include "pipeline/frame/checksum.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// Hashes each file once: an output of one stage is an input of the next.
class Checksums {
 public:
  explicit Checksums(fs::path folder) : folder_(std::move(folder)) {}

  /// Empty if `path` is as expected, otherwise what is wrong with it.
  std::string difference(const std::string& path, const std::string& expected) {
    if (!fs::exists(folder_ / path)) return path + ": is missing";
    const auto [known, is_new] = known_.try_emplace(path);
    if (is_new) known->second = sha256_of_path(folder_ / path);
    if (known->second == expected) return {};
    return path + ": its SHA-256 is " + known->second + "; expected " + expected;
  }
  int num_files() const { return static_cast<int>(known_.size()); }

 private:
  fs::path folder_;
  std::map<std::string, std::string> known_;
};

/// Of every file and folder in it, and of itself.
std::set<std::string> checksums_below(const fs::path& folder) {
  std::set<std::string> sums{sha256_of_path(folder)};
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() || entry.is_directory()) sums.insert(sha256_of_path(entry.path()));
  return sums;
}

/// Written under a temporary name by a run that was killed; the next run removes it.
bool is_leftover(const fs::path& file) {
  return file.filename().string().rfind(".partial-", 0) == 0;
}

}  // namespace

Verification verify_results(const fs::path& folder, const fs::path& data) {
  const std::vector<StageResult> results = read_stage_results(folder);
  if (results.empty())
    throw std::runtime_error(folder.string() + ": holds no results; run this patient first");
  Checksums checksums(folder);
  Verification verification;
  const auto check = [&](const auto& files, const std::string& whose) {
    for (const auto& [path, sha256] : files) {
      const std::string difference = checksums.difference(path, sha256);
      if (!difference.empty()) verification.differences.push_back(difference + " (" + whose + ")");
    }
  };
  const std::set<std::string> there =
      data.empty() ? std::set<std::string>() : checksums_below(data);
  int num_sources = 0;
  const auto check_sources = [&](const StageResult& result) {
    for (const auto& [role, sha256] : result.sources)
      if (!data.empty() && !there.contains(sha256))
        verification.differences.push_back("the " + role + " read for " + result.product +
                                           ": no file of " + data.string() + " has its SHA-256 " +
                                           sha256 + " (was it changed, or does it lie elsewhere?)");
    num_sources += data.empty() ? 0 : static_cast<int>(result.sources.size());
  };
  for (const StageResult& result : results) {
    check_sources(result);
    if (result.stage.empty()) verification.differences.push_back(result.reasons.front());
    check(result.outputs, "written by " + result.stage);
    check(result.inputs, "read for " + result.product);
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_leftover(entry.path()))
      verification.differences.push_back(entry.path().filename().string() +
                                         ": half-written, left by a run that was killed");
  verification.files_checked = checksums.num_files() + num_sources;
  return verification;
}

}  // namespace mammotwin
