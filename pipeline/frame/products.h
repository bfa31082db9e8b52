#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "pipeline/frame/stop_signals.h"

namespace mammotwin {

/// The folder that a file stands or will stand in; "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Absolute, with links followed, also where nothing is there yet (weakly_canonical alone leaves a
/// relative path of which nothing exists relative).
std::filesystem::path whole_path(const std::filesystem::path& path);

/// Makes a folder and those above it; a loss of power takes none of them away. Returns why it could
/// not.
std::error_code make_durable_folders(const std::filesystem::path& folder);

/// Files that appear together or not at all: each is written in a folder of this run's own, beside
/// the products and closed to other users, and renamed by `commit`. What is not committed is
/// removed when this goes out of scope.
class Products {
 public:
  /// Creates the folder of `main_product`. Throws std::runtime_error if it cannot be written.
  explicit Products(std::filesystem::path main_product);
  ~Products();
  Products(const Products&) = delete;
  Products& operator=(const Products&) = delete;

  /// Temporary path for a file that will be called `name` beside the main product; "dicom/cc.dcm"
  /// is in a folder there.
  std::filesystem::path write(const std::string& name);
  std::filesystem::path write_main() { return write(main_.filename().string()); }

  std::filesystem::path folder() const;
  std::vector<std::string> names() const;

  /// Renames all, the main product last; when it returns, a loss of power takes none of them away.
  /// Throws std::runtime_error on failure.
  void commit();

 private:
  std::filesystem::path main_;
  std::filesystem::path own_folder_;  ///< empty before the first `write`
  std::unique_ptr<EndsWithTheRun> own_folder_ends_;
  std::vector<std::pair<std::string, std::filesystem::path>> pending_;
};

/// Writes text under a temporary name and renames it to `path`. A link that stands there is
/// replaced, not followed. Throws std::runtime_error on failure; nothing has changed then.
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

}  // namespace mammotwin
