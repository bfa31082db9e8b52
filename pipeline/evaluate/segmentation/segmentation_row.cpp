#include "pipeline/evaluate/segmentation/segmentation_row.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/evaluate/segmentation/score.h"
#include "segmentation/segment.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

using nlohmann::json;

SegmentInput input_of(const SyntheticPatient& patient, const std::filesystem::path& image) {
  SegmentInput input;
  input.mri = image;
  input.side = patient.truth.region.side;
  for (const Lesion& lesion : patient.truth.lesions) {
    LesionSeed& seed = input.lesions.emplace_back();
    seed.id = lesion.id;
    seed.point_in_lps = lesion.centroid_in_lps + Eigen::Vector3d(1.5, -1.5, 1.5);
  }
  return input;
}

json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

void write_scan(const std::filesystem::path& path, const Volume<std::int16_t>& scan) {
  auto image = scan.like<float>(0);
  std::copy(scan.values.begin(), scan.values.end(), image.values.begin());
  write_image(path, image);
}

void keep_files(const std::string& name, const std::filesystem::path& image,
                const Segmentation& truth, const SegmentResult& found,
                const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(image, folder / (name + "_mri.nrrd"),
                             std::filesystem::copy_options::overwrite_existing);
  write_segmentation(folder / (name + "_true.nrrd"), truth);
  write_fractions(folder / (name + "_true_fractions.nrrd"), truth.fractions);
  write_fractions(folder / (name + "_found_fractions.nrrd"), found.segmentation.fractions);
  write_segmentation(folder / (name + "_found.nrrd"), found.segmentation);
  write_image(folder / (name + "_corrected.nrrd"), found.image);
}

void add_score(const SegmentationScore& score, json& row) {
  row["breast_dice"] = number(score.breast_dice);
  row["fibroglandular_dice"] = number(score.fibroglandular_dice);
  row["clear_fibroglandular_dice"] = number(score.clear_fibroglandular_dice);
  row["fibroglandular_fraction_dice"] = number(score.fibroglandular_fraction_dice);
  row["fibroglandular_volume_ratio"] = number(score.fibroglandular_volume_ratio);
  row["nipple_mm"] = number(score.nipple_mm);
  row["lesion_dice"] = number(score.lesion_dice);
  row["lesion_centroid_mm"] = number(score.lesion_centroid_mm);
  if (score.chest_wall) {
    row["chest_wall_mean_mm"] = score.chest_wall->mean;
    row["chest_wall_median_mm"] = score.chest_wall->median;
    row["chest_wall_p95_mm"] = score.chest_wall->p95;
    row["chest_wall_max_mm"] = score.chest_wall->largest;
  }
  if (score.skin_surface) {
    row["skin_surface_mean_mm"] = score.skin_surface->mean;
    row["skin_surface_p95_mm"] = score.skin_surface->p95;
  }
}

void add_quality(const SegmentResult& result, double true_skin, json& row) {
  const SegmentQuality& q = result.quality;
  row["status"] = to_string(q.status);
  row["reasons"] = q.reasons;
  row["found_contrast"] = q.contrast;
  row["chest_wall_doubt"] = number(q.chest_wall_doubt);
  row["chest_wall_fat_behind"] = number(q.chest_wall_fat_behind);
  row["skin_thickness_mm"] = number(true_skin);
  row["skin_thickness_found_mm"] = q.skin_thickness_mm;
  row["skin_thickness_range_mm"] = {number(q.skin_thickness_low_mm),
                                    number(q.skin_thickness_high_mm)};
  row["skin_thickness_error_mm"] = number(std::abs(q.skin_thickness_mm - true_skin));
}

constexpr const char* pre_post = ", before and after contrast agent";
constexpr const char* varied = ", varied";

json empty_row(const SegmentationCase& c) {
  json row = {{"name", c.name},
              {"contrast", name_of(c.contrast) + (c.varied     ? varied
                                                  : c.make_pre ? pre_post
                                                               : "")},
              {"reason", nullptr}};
  for (const char* key :
       {"breast_dice", "fibroglandular_dice", "clear_fibroglandular_dice",
        "fibroglandular_fraction_dice", "chest_wall_mean_mm", "skin_thickness_error_mm",
        "skin_surface_mean_mm", "nipple_mm", "lesion_dice", "lesion_centroid_mm"})
    row[key] = nullptr;
  return row;
}

/// How a figure is summarised: the aim that it must reach, from below or above.
struct Aim {
  const char* key;
  const char* title;
  bool at_least;
  double value;
};

constexpr Aim aims[] = {{"breast_dice", "breast Dice", true, 0.98},
                        {"skin_surface_mean_mm", "skin surface mean", false, 0.5},
                        {"chest_wall_median_mm", "wall median", false, 1.0},
                        {"chest_wall_mean_mm", "wall mean", false, 2.5},
                        {"chest_wall_p95_mm", "wall p95", false, 5},
                        {"fibroglandular_dice", "gland Dice", true, 0.90},
                        {"clear_fibroglandular_dice", "gland, no halves", true, 0.90},
                        {"fibroglandular_fraction_dice", "gland, fractions", true, 0.90},
                        {"skin_thickness_error_mm", "skin thickness", false, 0.5},
                        {"lesion_dice", "lesion Dice", true, 0.8},
                        {"lesion_centroid_mm", "lesion centroid", false, 1},
                        {"nipple_mm", "nipple", false, 3}};

void summarise(const Aim& aim, const std::vector<const json*>& rows, std::ostream& out) {
  std::vector<double> values;
  std::string missed;
  for (const json* row : rows) {
    const json& value = row->value(aim.key, json(nullptr));
    if (value.is_null()) continue;
    values.push_back(value.get<double>());
    if (aim.at_least ? values.back() < aim.value : values.back() > aim.value)
      missed += " " + row->at("name").get<std::string>();
  }
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double v : values) sum += v;
  out << "  " << std::left << std::setw(18) << aim.title << std::right << " mean "
      << sum / static_cast<double>(values.size()) << "  median " << values[values.size() / 2]
      << "  worst " << (aim.at_least ? values.front() : values.back()) << "  (aim "
      << (aim.at_least ? ">= " : "<= ") << aim.value << ")"
      << (missed.empty() ? "" : "  missed by" + missed) << "\n";
}

}  // namespace

json segmentation_row(const SegmentationCase& c, const std::filesystem::path& image,
                      const std::filesystem::path& keep) {
  json row = empty_row(c);
  const auto pre = image.parent_path() / ("pre_" + image.filename().string());
  try {
    const SyntheticPatient patient = c.make();
    row["noise"] = patient.options.scan.noise;
    row["shading_ratio"] = patient.truth.shading_ratio;
    write_scan(image, patient.scan.image);
    SegmentInput input = input_of(patient, image);
    if (c.make_pre) {
      write_scan(pre, c.make_pre().scan.image);
      input.pre = pre;
    }
    const auto start = std::chrono::steady_clock::now();
    const SegmentResult result = segment(input, {});
    row["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Segmentation truth = true_segmentation(patient.tissue, patient.labels, patient.truth);
    constexpr double off_muscle_mm = 3;
    const bool drawn = std::isfinite(patient.truth.skin_thickness_mm);
    if (!keep.empty()) keep_files(c.name, image, truth, result, keep);
    add_quality(result, patient.truth.skin_thickness_mm, row);
    add_score(score_segmentation(truth, result.segmentation, drawn ? 0 : off_muscle_mm), row);
  } catch (const std::exception& error) {
    row["status"] = "refused";
    row["reason"] = error.what();
  }
  std::filesystem::remove(image);
  std::filesystem::remove(pre);
  return row;
}

std::string segmentation_summary(const json& cases) {
  std::ostringstream out;
  out << std::setprecision(3);
  for (const std::string& contrast :
       {std::string("fat_suppressed"), std::string("not_suppressed"),
        std::string("not_suppressed") + pre_post, std::string("fat_suppressed") + varied,
        std::string("not_suppressed") + varied})
    for (const bool drawn : {true, false}) {
      std::vector<const json*> rows;
      for (const json& row : cases)
        if (row.at("contrast") == contrast &&
            (row.at("name").get<std::string>().rfind("seed-", 0) == 0) == drawn)
          rows.push_back(&row);
      if (rows.empty()) continue;
      out << (drawn ? "drawn, " : "label maps, ") << contrast << ", " << rows.size()
          << " breasts\n";
      for (const Aim& aim : aims) summarise(aim, rows, out);
    }
  return out.str();
}

}  // namespace mammotwin
