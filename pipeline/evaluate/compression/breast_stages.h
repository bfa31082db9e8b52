#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pipeline/evaluate/cases/breasts_to_press.h"
#include "pipeline/evaluate/compression/pressed_places.h"

namespace mammotwin {

/// One breast under way through the stages, each by its command. All throw std::runtime_error with
/// the stage's reason where it left no product.
class BreastStages {
 public:
  /// Segments it, unless its segmentation was drawn. `breast` must outlive this.
  explicit BreastStages(const BreastToPress& breast, bool is_drawn = false);

  const BreastToPress& breast() const { return breast_; }
  const std::filesystem::path& segmentation() const { return segmentation_; }

  /// Fits `mesh`; makes its folder.
  void fit(const std::filesystem::path& mesh, std::vector<std::string> options = {}) const;

  /// CPU seconds of unloading the fitted mesh `prone` to `unloaded`.
  double unload(const std::filesystem::path& prone, const std::filesystem::path& unloaded,
                std::vector<std::string> options = {}) const;

  /// CPU seconds of pressing `mesh` to `pressed`, whose folder is made.
  double press(const std::string& view, const std::filesystem::path& mesh,
               const std::filesystem::path& pressed, std::vector<std::string> options = {}) const;

  /// `force_change` [fraction] and the moves (add_moves) from one compression to another.
  void compare(const FollowedPoints& followed, const std::string& view,
               const std::filesystem::path& base, const std::filesystem::path& changed,
               nlohmann::json& row) const;

 private:
  std::vector<std::string> inputs(const std::filesystem::path& mesh) const;

  const BreastToPress& breast_;
  const std::filesystem::path segmentation_;
};

/// Options of `fit` for a mesh of so many elements, "7x7x2".
std::vector<std::string> elements_options(std::string elements);

/// Gives each breast's rows, which `rows` makes one after the other, to the table `table`: 042 and
/// the real cases (breasts_to_press), whose files go to a folder of the table's name.
void tabulate_breasts(
    const std::filesystem::path& patient_toml, const std::filesystem::path& cases,
    const std::vector<std::string>& only, const std::filesystem::path& table,
    const std::function<void(const BreastToPress&,
                             const std::function<void(const nlohmann::json&)>& add)>& rows);

}  // namespace mammotwin
