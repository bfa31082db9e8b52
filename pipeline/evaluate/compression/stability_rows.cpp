#include "pipeline/evaluate/compression/stability_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

#include "pipeline/evaluate/cases/sorted_figures.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/breast_stages.h"
#include "pipeline/frame/products.h"
#include "segmentation/files/read_labels.h"
#include "segmentation/files/write_image_file.h"
#include "segmentation/mri/read_mri.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kPressedTo_mm = 55;

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

/// The breast's patient.toml in a folder that is made.
fs::path write_patient(const fs::path& folder, const RealBreast& breast) {
  std::ostringstream toml;
  toml << patient_toml_of(breast);
  for (const char* view : {"cc", "mlo"})
    toml << "[views." << view << "]\nthickness_mm = " << kPressedTo_mm << "\n";
  fs::create_directories(folder);
  write_text_atomically(folder / "patient.toml", toml.str());
  return folder / "patient.toml";
}

RealBreast mirrored(RealBreast breast, double plane) {
  breast.side = breast.side == Side::left ? Side::right : Side::left;
  for (Eigen::Vector3d& x : breast.lesions) x.x() = 2 * plane - x.x();
  return breast;
}

/// A breast as it is or with its image changed, segmented.
struct ImagedBreast {
  BreastToPress files;
  BreastStages stages;

  ImagedBreast(const fs::path& folder, const RealBreast& breast)
      : files{name_and_side(breast), write_patient(folder, breast), folder}, stages(files) {}
  ImagedBreast(const ImagedBreast&) = delete;
};

/// A breast to press, and where that goes.
struct ReadyBreast {
  std::shared_ptr<const ImagedBreast> imaged;
  fs::path folder, prone, mesh;
  std::vector<std::string> options = {};
};

json new_stability_row(const StabilityCase& asked, const std::string& view,
                       const std::string& change) {
  json row{{"name", name_and_side(asked.breast)}, {"view", view}, {"change", change}};
  for (const char* key :
       {"lesion_mm", "tissue_median_mm", "tissue_p95_mm", "force_N", "force_change", "swing_mm",
        "roll_deg", "newton_iterations", "cpu_seconds", "reason"})
    row[key] = nullptr;
  return row;
}

/// One breast under way: its base, then its changes against that.
class StabilityRun {
 public:
  StabilityRun(const StabilityCase& asked)
      : asked_(asked),
        image_(asked.breast),
        base_(base()),
        followed_(base_.imaged->stages.segmentation(), base_.prone) {}

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
      if (!changed_.contains(change.name)) changed_.emplace(change.name, changed(change));
    } catch (const std::exception& error) {
      row["reason"] = error.what();
      return row;
    }
    const ReadyBreast& breast = changed_.at(change.name);
    if (press_into(row, breast, view)) compare_into(row, breast, view, change.mirror);
    return row;
  }

 private:
  /// An MRI's base, too, is read from the file that is written here: what its headers said is lost
  /// to all alike.
  ReadyBreast base() const {
    ReadyBreast ready{{}, asked_.folder / "base", {}, {}};
    RealBreast breast = asked_.breast;
    fs::create_directories(ready.folder);
    if (!breast.is_label_map) image_.write(breast.image = ready.folder / "image.nrrd", {});
    ready.imaged = std::make_shared<ImagedBreast>(ready.folder, breast);
    fit(ready, {});
    unload(ready);
    return ready;
  }

  /// What the change leaves as it is stays the base's.
  ReadyBreast changed(const InputChange& change) const {
    ReadyBreast ready = base_;
    ready.folder = asked_.folder / change.name;
    if (!change.preset.empty()) ready.options = {"--materials-preset", change.preset};
    if (change.of_image()) {
      RealBreast breast = asked_.breast;
      if (change.mirror) breast = mirrored(breast, image_.mirror_plane());
      fs::create_directories(ready.folder);
      image_.write(breast.image = ready.folder / "image.nrrd", change);
      ready.imaged = std::make_shared<ImagedBreast>(ready.folder, breast);
      fit(ready, {});
    } else if (change.more_elements != 0) {
      const std::array<int, 3> n = stage_sidecar(base_.prone).at("quality").at("elements");
      std::string elements;
      for (const int along : n)
        elements += (elements.empty() ? "" : "x") + std::to_string(along + change.more_elements);
      fit(ready, elements_options(elements));
    }
    if (ready.prone != base_.prone || !change.preset.empty()) unload(ready);
    if (change.thicker_mm != 0)
      for (const std::string& view : asked_.views)
        ready.options.insert(ready.options.end(),
                             {"--views-" + view + "-thickness-mm",
                              std::to_string(kPressedTo_mm + change.thicker_mm)});
    return ready;
  }

  void fit(ReadyBreast& ready, std::vector<std::string> options) const {
    ready.prone = ready.mesh = ready.folder / "prone.vtu";
    ready.imaged->stages.fit(ready.prone, std::move(options));
  }

  /// Where that is asked.
  void unload(ReadyBreast& ready) const {
    if (!asked_.unload) return;
    fs::create_directories(ready.folder);
    ready.mesh = ready.folder / "unloaded.vtu";
    ready.imaged->stages.unload(ready.prone, ready.mesh, ready.options);
  }

  bool press_into(json& row, const ReadyBreast& breast, const std::string& view) {
    try {
      const fs::path product = breast.folder / (view + ".vtu");
      row["cpu_seconds"] = breast.imaged->stages.press(view, breast.mesh, product, breast.options);
      const json quality = stage_sidecar(product).at("quality");
      for (const char* key : {"swing_mm", "roll_deg", "newton_iterations", "force_N"})
        row[key] = quality.at(key);
      return true;
    } catch (const std::exception& error) {
      row["reason"] = error.what();
      return false;
    }
  }

  void compare_into(json& row, const ReadyBreast& breast, const std::string& view,
                    bool mirror) const {
    const double plane = image_.mirror_plane();
    const auto counterpart = [&](Eigen::Vector3d x) {
      if (mirror) x.x() = 2 * plane - x.x();
      return x;
    };
    const auto places = [&](const ReadyBreast& of) {
      return PressedPlaces(of.folder / (view + ".vtu"), view, of.imaged->stages.segmentation());
    };
    const PressedPlaces base = places(base_), changed = places(breast);
    const auto tissue = moves(followed_.tissue, base, changed, counterpart);
    const auto lesions = moves(followed_.lesions, base, changed, counterpart);
    if (!lesions.empty()) row["lesion_mm"] = lesions.back();
    row["tissue_median_mm"] = median_of_sorted(tissue);
    row["tissue_p95_mm"] = tissue[static_cast<std::size_t>(std::ceil(0.95 * tissue.size())) - 1];
    row["force_change"] = row.at("force_N").get<double>() / base_force_.at(view).get<double>() - 1;
  }

  const StabilityCase& asked_;
  const BreastImage image_;
  const ReadyBreast base_;
  const FollowedPoints followed_;
  std::map<std::string, json> base_force_;      ///< by view; null: it was not pressed
  std::map<std::string, ReadyBreast> changed_;  ///< by change
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
