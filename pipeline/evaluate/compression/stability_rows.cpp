#include "pipeline/evaluate/compression/stability_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "pipeline/evaluate/cases/sorted_figures.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/pressed_places.h"
#include "pipeline/frame/products.h"
#include "segmentation/files/read_labels.h"
#include "segmentation/files/write_image_file.h"
#include "segmentation/mri/read_mri.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kPressedTo_mm = 55;
constexpr int kMostPressCpuSeconds = 1800;

/// What one compression needs, and where its products go.
struct StabilityInputs {
  fs::path folder;
  RealBreast breast;
  fs::path segmentation, prone;
  fs::path unloaded = {};  ///< empty: the prone shape is pressed
};

/// A label map or an MRI, whichever the breast has.
class BreastImage {
 public:
  explicit BreastImage(const RealBreast& breast) {
    if (breast.is_label_map)
      image_ = read_labels(breast.image);
    else
      image_ = read_mri(breast.image).image;
  }

  double mirror_plane() const {
    return std::visit([](const auto& image) { return mammotwin::mirror_plane(image); }, image_);
  }

  void write(const fs::path& path, const InputChange& change) const {
    std::visit([&](const auto& image) { write_values(path, changed_image(image, change)); },
               image_);
  }

 private:
  template <class T>
  static void write_values(const fs::path& path, const Volume<T>& image) {
    using Written = std::conditional_t<std::is_same_v<T, float>, float, std::uint8_t>;
    const std::vector<Written> values(image.values.begin(), image.values.end());
    const auto& [size, spacing, origin, all] = image;
    write_nrrd(path,
               {{size.x(), size.y(), size.z()},
                {spacing.x(), spacing.y(), spacing.z()},
                {origin.x(), origin.y(), origin.z()}},
               values.data(), 1, {});
  }

  std::variant<Volume<std::uint16_t>, Volume<float>> image_;
};

/// CPU seconds.
double run_stage(const std::string& stage, std::vector<std::string> arguments,
                 const StabilityInputs& inputs, const fs::path& product, int most_seconds) {
  return run_to_product(
      {stage, std::move(arguments), product, inputs.folder / "patient.toml", {}, most_seconds});
}

void write_patient(const StabilityInputs& inputs, const InputChange& change,
                   const std::optional<Eigen::Vector3i>& elements) {
  std::ostringstream toml;
  toml << patient_toml_of(inputs.breast);
  if (elements)
    toml << "[fit]\nelements = [" << elements->x() << ", " << elements->y() << ", " << elements->z()
         << "]\n";
  for (const char* view : {"cc", "mlo"})
    toml << "[views." << view << "]\nthickness_mm = " << kPressedTo_mm + change.thicker_mm << "\n";
  write_text_atomically(inputs.folder / "patient.toml", toml.str());
}

std::vector<std::string> tissue_of(const StabilityInputs& inputs) {
  return {inputs.segmentation.string(), fractions_beside(inputs.segmentation).string()};
}

void fit(const StabilityInputs& inputs) {
  run_stage("fit", tissue_of(inputs), inputs, inputs.prone, kMostStageCpuSeconds);
}

/// Where that is asked.
void unload(const StabilityInputs& inputs) {
  if (inputs.unloaded.empty()) return;
  std::vector<std::string> of_mesh = tissue_of(inputs);
  of_mesh.push_back(inputs.prone.string());
  run_stage("unload", of_mesh, inputs, inputs.unloaded, kMostStageCpuSeconds);
}

RealBreast mirrored(RealBreast breast, double plane) {
  breast.side = breast.side == Side::left ? Side::right : Side::left;
  for (Eigen::Vector3d& x : breast.lesions) x.x() = 2 * plane - x.x();
  return breast;
}

/// An MRI's base, too, is read from the file that is written here: what its headers said is lost to
/// all alike.
StabilityInputs base_inputs(const StabilityCase& asked, const BreastImage& image) {
  const fs::path folder = asked.folder / "base";
  StabilityInputs inputs{folder, asked.breast, folder / "segmentation.seg.nrrd",
                         folder / "prone.vtu"};
  fs::create_directories(folder);
  if (!asked.breast.is_label_map) image.write(inputs.breast.image = folder / "image.nrrd", {});
  if (asked.unload) inputs.unloaded = folder / "unloaded.vtu";
  write_patient(inputs, {}, {});
  run_stage("segment", {}, inputs, inputs.segmentation, kMostStageCpuSeconds);
  fit(inputs);
  unload(inputs);
  return inputs;
}

/// What the change leaves as it is stays the base's.
StabilityInputs changed_inputs(const StabilityInputs& base, const InputChange& change,
                               const BreastImage& image) {
  StabilityInputs inputs = base;
  inputs.folder = base.folder.parent_path() / change.name;
  fs::create_directories(inputs.folder);
  if (!change.preset.empty()) inputs.breast.preset = change.preset;
  if (change.mirror) inputs.breast = mirrored(inputs.breast, image.mirror_plane());
  if (change.of_image()) {
    image.write(inputs.breast.image = inputs.folder / "image.nrrd", change);
    inputs.segmentation = inputs.folder / "segmentation.seg.nrrd";
  }
  std::optional<Eigen::Vector3i> elements;
  if (change.more_elements != 0) {
    const std::array<int, 3> n = stage_sidecar(base.prone).at("quality").at("elements");
    elements = Eigen::Vector3i(n[0], n[1], n[2]).array() + change.more_elements;
  }
  write_patient(inputs, change, elements);
  const bool other_mesh = change.of_image() || elements;
  if (change.of_image())
    run_stage("segment", {}, inputs, inputs.segmentation, kMostStageCpuSeconds);
  if (other_mesh) {
    inputs.prone = inputs.folder / "prone.vtu";
    fit(inputs);
  }
  if (!inputs.unloaded.empty() && (other_mesh || !change.preset.empty())) {
    inputs.unloaded = inputs.folder / "unloaded.vtu";
    unload(inputs);
  }
  return inputs;
}

json press_view(const StabilityInputs& inputs, const std::string& view, double& cpu_seconds) {
  const fs::path product = inputs.folder / (view + ".vtu");
  const fs::path& mesh = inputs.unloaded.empty() ? inputs.prone : inputs.unloaded;
  cpu_seconds = run_stage("compress",
                          {view, inputs.segmentation.string(),
                           fractions_beside(inputs.segmentation).string(), mesh.string()},
                          inputs, product, kMostPressCpuSeconds);
  return stage_sidecar(product).at("quality");
}

json new_stability_row(const StabilityCase& asked, const std::string& view,
                       const std::string& change) {
  json row{{"name", name_and_side(asked.breast)}, {"view", view}, {"change", change}};
  for (const char* key : {"lesion_mm", "tissue_median_mm", "tissue_p95_mm", "force_change",
                          "swing_mm", "roll_deg", "newton_iterations", "cpu_seconds", "reason"})
    row[key] = nullptr;
  return row;
}

/// One breast under way: its base, then its changes against that.
class StabilityRun {
 public:
  StabilityRun(const StabilityCase& asked)
      : asked_(asked),
        image_(asked.breast),
        base_(base_inputs(asked, image_)),
        followed_(base_.segmentation, base_.prone) {}

  json base_row(const std::string& view) {
    json row = new_stability_row(asked_, view, "none");
    press_into(row, base_, view);
    base_force_[view] = row.value("force_N", json());
    return row;
  }

  json changed_row(const std::string& view, const InputChange& change) {
    json row = new_stability_row(asked_, view, change.name);
    if (base_force_.at(view).is_null()) {
      row["reason"] = "the breast as it is was not pressed";
      return row;
    }
    try {
      if (!changed_.contains(change.name))
        changed_.emplace(change.name, changed_inputs(base_, change, image_));
    } catch (const std::exception& error) {
      row["reason"] = error.what();
      return row;
    }
    const StabilityInputs& inputs = changed_.at(change.name);
    if (press_into(row, inputs, view)) compare_into(row, inputs, view, change.mirror);
    return row;
  }

 private:
  bool press_into(json& row, const StabilityInputs& inputs, const std::string& view) {
    try {
      double cpu_seconds = 0;
      const json quality = press_view(inputs, view, cpu_seconds);
      for (const char* key : {"swing_mm", "roll_deg", "newton_iterations", "force_N"})
        row[key] = quality.at(key);
      row["cpu_seconds"] = cpu_seconds;
      return true;
    } catch (const std::exception& error) {
      row["reason"] = error.what();
      return false;
    }
  }

  void compare_into(json& row, const StabilityInputs& inputs, const std::string& view,
                    bool mirror) const {
    const double plane = image_.mirror_plane();
    const auto counterpart = [&](Eigen::Vector3d x) {
      if (mirror) x.x() = 2 * plane - x.x();
      return x;
    };
    const auto places = [&](const StabilityInputs& of) {
      return PressedPlaces(of.folder / (view + ".vtu"), view, of.segmentation);
    };
    const PressedPlaces base = places(base_), changed = places(inputs);
    const auto tissue = moves(followed_.tissue, base, changed, counterpart);
    const auto lesions = moves(followed_.lesions, base, changed, counterpart);
    if (!lesions.empty()) row["lesion_mm"] = lesions.back();
    row["tissue_median_mm"] = median_of_sorted(tissue);
    row["tissue_p95_mm"] = tissue[static_cast<std::size_t>(std::ceil(0.95 * tissue.size())) - 1];
    row["force_change"] = row.at("force_N").get<double>() / base_force_.at(view).get<double>() - 1;
  }

  const StabilityCase& asked_;
  const BreastImage image_;
  const StabilityInputs base_;
  const FollowedPoints followed_;
  std::map<std::string, json> base_force_;          ///< by view; null: it was not pressed
  std::map<std::string, StabilityInputs> changed_;  ///< by change
};

}  // namespace

void add_stability_rows(const StabilityCase& asked,
                        const std::function<void(const nlohmann::json&)>& add) {
  StabilityRun run(asked);
  for (const std::string& view : asked.views) add(run.base_row(view));
  for (const InputChange& change : asked.changes)
    for (const std::string& view : asked.views) add(run.changed_row(view, change));
}

}  // namespace mammotwin
