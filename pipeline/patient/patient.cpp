#include "pipeline/patient/patient.h"

#include <stdexcept>

#include "pipeline/frame/nearest_name.h"
#include "pipeline/frame/toml_file.h"
#include "segmentation/files/detached_data.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr char kDefaultMri[] = "mri";  // a folder beside patient.toml
constexpr ForeignTissue kTissues[] = {ForeignTissue::air,        ForeignTissue::skin,
                                      ForeignTissue::fat,        ForeignTissue::fibroglandular,
                                      ForeignTissue::transition, ForeignTissue::muscle,
                                      ForeignTissue::lesion};

void refuse_unknown(const std::string& where, const std::string& key, const Settings& settings) {
  if (settings.find(key)) return;
  throw std::runtime_error(where + ": unknown key " + key + "; the nearest known one is " +
                           nearest_name(key, settings.keys()));
}

/// A header's voxels are as much of the input as itself.
std::vector<fs::path> with_detached_data(std::vector<fs::path> files) {
  const std::size_t headers = files.size();
  for (std::size_t n = 0; n < headers; ++n)
    if (const auto data = detached_data_file(files[n])) files.push_back(*data);
  return files;
}

}  // namespace

void Patient::declare(Settings& settings) {
  declare_inputs(settings);
  declare_scan(settings);
  declare_segment(settings);
  declare_fit(settings);
  declare_gravity(settings, gravity);
  declare_compression(settings, compression);
  declare_registration(settings, registration);
  declare_view(settings, "cc", cc);
  declare_view(settings, "mlo", mlo);
}

void Patient::declare_inputs(Settings& s) {
  s.flag(
      "privacy.keep_names", keeps_names_,
      "results name input files as they are called; else by role and checksum, as hospitals name "
      "files after patients");
  s.choice("side", side_, {{"left", Side::left}, {"right", Side::right}},
           "the breast; default: the lesions' side");
  s.path("mri.path", mri_, "DICOM folder, NIfTI, NRRD or MHA; default: the folder mri");
  s.private_text("mri.series", series_, "series number or UID, where the folder holds several");
  s.path("mri.pre", pre_, "the image before contrast agent, where it lies apart");
  s.private_text("mri.pre_series", pre_series_,
                 "its series number or UID (with phase, \"NUMBER:PHASE\")");
  s.path("mri.compared", compared_,
         "another image of the study, in which the chest wall must lie where it lies in the one "
         "that is read");
  s.private_text("mri.compared_series", compared_series_,
                 "its series number or UID; default: one of the folder's others, where it holds "
                 "several");
  s.choice("mri.fat_suppressed", fat_suppressed_, {{"yes", true}, {"no", false}},
           "is the fat dark? default: decided from the image");
  s.path("labels.path", labels_, "label map made elsewhere, taken as the whole segmentation");
  for (const ForeignTissue tissue : kTissues)
    s.label_values(
        "labels." + to_string(tissue), label_values_[tissue],
        "values of `labels.path` that are " + to_string(tissue) +
            (tissue == ForeignTissue::transition ? " (half fat, half fibroglandular)" : ""));
  s.point("nipple.point_lps_mm", nipple_lps_mm_, {-kFarthestMm, kFarthestMm, "mm"},
          "the nipple, patient LPS; default: what shows on the skin");
  s.path("nipple.markups", nipple_markups_, "the nipple as 3D Slicer markups (.mrk.json)");
  s.path("chest_wall.markups", wall_markups_,
         "the muscle's front, drawn in a few slices as 3D Slicer markups; interpolated between");
  s.path("region.markups", region_markups_,
         "the breast's region as a 3D Slicer ROI; its left, right, lower and upper sides count");
}

void Patient::declare_scan(Settings& s) {
  s.path("scan.path", scan_, "scanned skin instead of an image: PLY, STL, OBJ, OFF or XYZ");
  s.number("scan.unit_mm", scan_options_.unit_mm, {1e-6, 1e6, "mm"}, "length of the file's unit");
  s.point("scan.base_point", scan_options_.base_point, {-1e9, 1e9},
          "a point of the plane that the breast stands on, in the file's axes and unit; default: "
          "behind the scan's rim");
  s.point("scan.base_normal", scan_options_.base_normal, {-1e9, 1e9},
          "its normal, in the file's axes");
  s.number("scan.base_depth_mm", scan_options_.base_depth_mm, {2, 100, "mm"},
           "how far behind the rim's plane the base lies where it is not given");
  s.point("scan.up", scan_up_, {-1e9, 1e9},
          "direction to the head in the file's axes; default [0, 0, 1]");
}

Pose Patient::imaged_pose(const std::string& patient_position) const {
  if (gravity.imaged) return *gravity.imaged;
  if (scan_) return Pose::none;
  return patient_position.ends_with("S") ? Pose::supine : Pose::prone;
}

std::optional<fs::path> Patient::scan_file() const {
  if (!scan_) return std::nullopt;
  if (mri_ || labels_)
    throw std::runtime_error(file_.string() +
                             ": scan.path stands beside mri.path or labels.path; "
                             "expected one of them");
  return resolve(*scan_);
}

ScannedSkinOptions Patient::scan_options() const {
  ScannedSkinOptions options = scan_options_;
  if (options.base_point.has_value() != options.base_normal.has_value())
    throw std::runtime_error(file_.string() +
                             ": scan.base_point and scan.base_normal belong "
                             "together; expected both or none");
  options.up = scan_up_.value_or(options.up);
  options.side = side_.value_or(Side::left);
  return options;
}

void Patient::declare_segment(Settings& s) {
  s.number("segment.skin_thickness_mm", segment.skin_thickness_mm, {0.5, 5, "mm"},
           "skin thickness where it is known; measured otherwise");
  s.choice("segment.lesion_method", segment.lesion_method,
           {{"half_maximum", LesionMethod::half_maximum},
            {"random_walker", LesionMethod::random_walker}},
           "how a lesion's extent is found from its point");
  s.number("segment.lesion_reach_mm", segment.lesion_reach_mm, {5, 60, "mm"},
           "a lesion reaches at most this far from its point");
  s.number("segment.wall_stiffness", segment.wall_stiffness, {0.01, 1, "per mm^2"},
           "stiffness of the chest wall's search");
  s.flag("segment.nifti", nifti, "writes labels.nii.gz and mri.nii.gz, too");
}

void Patient::declare_fit(Settings& s) {
  s.integers("fit.elements", fit.elements, {1, 16},
             "elements along x, z and from chest wall to skin; default: from the skin's area");
  s.number("fit.accuracy_mm", fit.accuracy_mm, {0.05, 5, "mm"},
           "skin RMS that decides how many elements stand along x and z");
  s.number("fit.smoothing", fit.smoothing, {1e-12, 1e-3},
           "weight of the Sobolev term; default: from the data's noise");
  s.number("fit.shape", fit.shape, {0.1, 10}, "weight of well-shaped elements against closeness");
  s.integer("fit.max_iterations", fit.max_iterations, {1, 10000},
            "iterations of the least-squares solver, in all");
  s.integer("fit.verbosity", fit.verbosity, {0, 2},
            "1: a line for each iteration of the fit; 2: the solver's full reports, too");
}

const ViewSettings& Patient::view(const std::string& name) const {
  if (name == "cc") return cc;
  if (name == "mlo") return mlo;
  throw std::logic_error("no view is called " + name);
}

void Patient::read(const fs::path& file, Settings& settings) {
  file_ = file;
  for (const auto& [key, value] : read_toml(file)) {
    if (key.starts_with("lesions."))
      throw std::runtime_error(file.string() +
                               ": [lesions] is one table; expected [[lesions]] with two brackets, "
                               "once for each lesion");
    if (key == "lesions") {
      read_lesions(file.string(), value);
      continue;
    }
    refuse_unknown(file.string(), key, settings);
    settings.assign(file.string() + ": " + key, key, value);
  }
}

void Patient::read(const fs::path& file) {
  Settings settings;
  declare(settings);
  read(file, settings);
}

void Patient::read_lesions(const std::string& file, const json& list) {
  if (!list.is_array()) throw std::runtime_error(file + ": lesions: expected tables [[lesions]]");
  for (const json& table : list) {
    LesionEntry& entry = lesions_.emplace_back();
    const std::string where = "lesions[" + std::to_string(lesions_.size() - 1) + "]";
    Settings settings;
    declare_lesion(settings, "", entry);
    if (!table.is_object()) throw std::runtime_error(file + ": " + where + ": expected a table");
    for (const auto& [key, value] : table.items()) {
      refuse_unknown(file + ": " + where, key, settings);
      settings.assign(file + ": " + where + "." + key, key, value);
    }
    require_one_place(file + ": " + where, entry);
    if (entry.id) require_plain_id(file + ": " + where, *entry.id);
    if (!entry.id) entry.id = "L" + std::to_string(lesions_.size());
  }
}

std::vector<NamedFile> Patient::named_files() const {
  std::vector<NamedFile> files;
  const auto add = [&](const std::string& key, const std::optional<fs::path>& path) {
    if (path) files.push_back({key, *path});
  };
  add("mri.path", mri_);
  add("mri.pre", pre_);
  add("mri.compared", compared_);
  add("labels.path", labels_);
  add("nipple.markups", nipple_markups_);
  add("chest_wall.markups", wall_markups_);
  add("region.markups", region_markups_);
  add("scan.path", scan_);
  add("unload.second_state", gravity.second_state);
  add("compress.paddle_stl", compression.paddle_stl);
  add("compress.support_stl", compression.support_stl);
  for (const char* name : {"cc", "mlo"}) {
    add("views." + std::string(name) + ".mammogram", view(name).mammogram);
    add("views." + std::string(name) + ".outline", view(name).outline);
  }
  for (std::size_t n = 0; n < lesions_.size(); ++n) {
    const std::string key = "lesions[" + std::to_string(n) + "]";
    add(key + ".markups", lesions_[n].markups);
    add(key + ".labels", lesions_[n].labels);
  }
  if (!mri_ && fs::exists(resolve(kDefaultMri))) files.push_back({"mri.path", kDefaultMri});
  return files;
}

void Patient::require_files() const {
  for (const NamedFile& file : named_files())
    if (!fs::exists(resolve(file.path)))
      throw std::runtime_error(file_.string() + ": " + file.key + ": " + file.path.string() +
                               ": no such file or folder (paths are absolute, or relative to " +
                               file_.filename().string() + ")");
}

Settings Patient::list_settings() const {
  static LesionEntry nobody;
  Settings settings;
  declare_lesion(settings, "lesions[].", nobody);
  return settings;
}

std::string Patient::name() const {
  return file_.empty() ? "" : fs::absolute(file_).parent_path().filename().string();
}

fs::path Patient::resolve(const fs::path& path) const {
  return path.is_absolute() ? path : file_.parent_path() / path;
}

std::optional<fs::path> Patient::second_state() const {
  if (!gravity.second_state) return std::nullopt;
  return resolve(*gravity.second_state);
}

LesionSeed Patient::seed_of(const LesionEntry& entry) const {
  LesionSeed seed;
  seed.id = *entry.id;
  seed.point_in_lps = entry.point_lps_mm;
  seed.radius_mm = entry.radius_mm;
  if (entry.markups) seed.markups = resolve(*entry.markups);
  if (entry.labels) {
    seed.label_map = resolve(*entry.labels);
    seed.label_value = static_cast<std::uint16_t>(entry.label);
  }
  return seed;
}

LabelValues Patient::label_values() const {
  LabelValues values;
  for (const auto& [tissue, numbers] : label_values_)
    for (const int number : numbers)
      if (!values.emplace(static_cast<std::uint16_t>(number), tissue).second)
        throw std::runtime_error(file_.string() + ": labels: the value " + std::to_string(number) +
                                 " is given to two tissues");
  return values;
}

SegmentInput Patient::segment_input() const {
  SegmentInput input;
  const fs::path default_mri = resolve(kDefaultMri);
  if (mri_)
    input.mri = resolve(*mri_);
  else if (fs::exists(default_mri))
    input.mri = default_mri;
  if (labels_) input.label_map = resolve(*labels_);
  if (!input.mri && !input.label_map)
    throw std::runtime_error(file_.string() +
                             ": no image: set mri.path (DICOM folder, NIfTI, NRRD, "
                             "MHA), labels.path or scan.path, or put the series in " +
                             default_mri.string());
  input.series = series_;
  if (pre_) input.pre = resolve(*pre_);
  input.pre_series = pre_series_;
  if (compared_) input.compared = resolve(*compared_);
  input.compared_series = compared_series_;
  input.fat_suppressed = fat_suppressed_;
  input.label_values = label_values();
  input.side = side_;
  for (const LesionEntry& entry : lesions_) input.lesions.push_back(seed_of(entry));
  input.nipple_in_lps = nipple_lps_mm_;
  if (nipple_markups_) input.nipple_markups = resolve(*nipple_markups_);
  if (wall_markups_) input.wall_markups = resolve(*wall_markups_);
  if (region_markups_) input.region_markups = resolve(*region_markups_);
  return input;
}

std::vector<fs::path> Patient::segment_files() const {
  if (const auto scan = scan_file()) return {*scan};
  const SegmentInput input = segment_input();
  std::vector<fs::path> files;
  for (const auto& path : {input.mri, input.pre, input.label_map, input.nipple_markups,
                           input.wall_markups, input.region_markups})
    if (path) files.push_back(*path);
  for (const LesionSeed& seed : input.lesions)
    for (const auto& path : {seed.markups, seed.label_map})
      if (path) files.push_back(*path);
  return with_detached_data(std::move(files));
}

json Patient::list_parameters(const std::vector<std::string>& prefixes) const {
  json parameters = json::object();
  for (const std::string& prefix : prefixes) {
    if (prefix != "lesions.") continue;
    for (std::size_t n = 0; n < lesions_.size(); ++n) {
      LesionEntry entry = lesions_[n];
      Settings settings;
      declare_lesion(settings, "lesions[" + std::to_string(n) + "].", entry);
      parameters.update(settings.parameters({"lesions["}));
    }
  }
  return parameters;
}

}  // namespace mammotwin
