#include "pipeline/evaluate/segmentation/segmentation_change_rows.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/evaluate/cases/sorted_figures.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/pressed_places.h"
#include "pipeline/frame/products.h"
#include "pipeline/patient/patient.h"
#include "segmentation/body/breast_region.h"
#include "segmentation/image/distance.h"
#include "segmentation/mri/read_mri.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Mask = Volume<std::uint8_t>;

constexpr double kOffEdges_mm = 5;
constexpr double kWallMoved_mm = 5, kNippleMoved_mm = 8, kLesionMoved_mm = 3, kLeftOut = 0.03;

RealBreast breast_of(const fs::path& toml) {
  Patient patient;
  patient.read(toml);
  const SegmentInput input = patient.segment_input();
  if (!input.mri || !input.side || input.nipple_in_lps || input.wall_markups || input.pre)
    throw std::runtime_error(toml.string() +
                             ": takes a side, an MRI and lesions, and nothing placed by hand");
  RealBreast breast{toml.parent_path().filename().string(), *input.side, *input.mri, false};
  for (const LesionSeed& seed : input.lesions) {
    if (!seed.point_in_lps) throw std::runtime_error(toml.string() + ": lesions must be points");
    breast.lesions.push_back(*seed.point_in_lps);
  }
  return breast;
}

/// A segmentation and what its sidecar says of it.
struct Found {
  Segmentation segmentation;
  json sidecar;
};

Found segmented(RealBreast breast, const Volume<float>& image, const fs::path& folder) {
  fs::create_directories(folder);
  breast.image = folder / "image.nrrd";
  write_image(breast.image, image);
  write_text_atomically(folder / "patient.toml", patient_toml_of(breast));
  const fs::path product = folder / "segmentation.seg.nrrd";
  run_to_product({"segment", {}, product, folder / "patient.toml"});
  return {read_segmentation(product, fractions_beside(product)), stage_sidecar(product)};
}

/// The labels of `found` on the grid of `first`, seen where the change put each place; air beyond.
Mask seen_on(const Mask& first, const Mask& found, const ChangedMri& changed) {
  Mask seen = first.like<std::uint8_t>(label::air);
  for (int k = 0; k < first.size.z(); ++k)
    for (int j = 0; j < first.size.y(); ++j)
      for (int i = 0; i < first.size.x(); ++i) {
        const Eigen::Vector3i v = found.index(changed.changed_from_first(first.position(i, j, k)))
                                      .array()
                                      .round()
                                      .cast<int>();
        if (found.contains(v.x(), v.y(), v.z())) seen(i, j, k) = found(v.x(), v.y(), v.z());
      }
  return seen;
}

/// Breast voxels with one of `other` before or behind them: the wall is muscle behind, the skin's
/// surface air in front.
Mask border(const Mask& labels, std::uint8_t other, int step) {
  Mask out = labels.like<std::uint8_t>(0);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 1; j + 1 < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i)
        out(i, j, k) = label::is_breast(labels(i, j, k)) && labels(i, j + step, k) == other;
  return out;
}

BreastRegion shrunk(BreastRegion region, double mm) {
  region.x_min += mm, region.x_max -= mm, region.z_min += mm, region.z_max -= mm;
  return region;
}

/// Sorted distances from the border in `first`, within `region`, to that in `after` [mm].
std::vector<double> border_moves(const Mask& first, const Mask& after, const BreastRegion& region) {
  const Volume<float> distance = distance_to(after);
  std::vector<double> all;
  for (int k = 0; k < first.size.z(); ++k)
    for (int j = 0; j < first.size.y(); ++j)
      for (int i = 0; i < first.size.x(); ++i)
        if (first(i, j, k) && region.contains(first.position(i, j, k)))
          all.push_back(distance(i, j, k));
  std::sort(all.begin(), all.end());
  return all;
}

double at_share(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

/// Shares of the first one's breast, as far as its region holds it and the changed image shows it,
/// that lie outside the region found there: of what hangs in front of the breastbone's skin, as
/// regions are judged, and of all.
struct LeftOut {
  double of_hanging = 0, of_all = 0;
};

LeftOut left_out(const Segmentation& first, const Segmentation& after, const ChangedMri& changed) {
  const Mask hanging = hanging_tissue(
      find_region(first.labels, first.region.side, LabelsHold::one_side).pendant, first.labels);
  double all[2] = {0, 0}, outside[2] = {0, 0};  // flank and axilla, what hangs
  for (int k = 0; k < first.labels.size.z(); ++k)
    for (int j = 0; j < first.labels.size.y(); ++j)
      for (int i = 0; i < first.labels.size.x(); ++i) {
        const Eigen::Vector3d x = first.labels.position(i, j, k);
        if (!first.region.contains(x) || !label::is_breast(first.labels(i, j, k))) continue;
        const Eigen::Vector3d there = changed.changed_from_first(x);
        const Eigen::Vector3i v = changed.image.index(there).array().round().cast<int>();
        if (!changed.image.contains(v.x(), v.y(), v.z())) continue;
        const int hangs = hanging(i, j, k) ? 1 : 0;
        ++all[hangs];
        outside[hangs] += !after.region.contains(there);
      }
  return {outside[1] / std::max(1.0, all[1]),
          (outside[0] + outside[1]) / std::max(1.0, all[0] + all[1])};
}

std::vector<std::string> doubts_of(const json& sidecar) {
  std::vector<std::string> what;
  for (const json& doubt : sidecar.at("quality").at("doubts"))
    what.push_back(doubt.at("what").get<std::string>());
  return what;
}

json new_change_row(const SegmentationChangeCase& asked, const std::string& change) {
  json row{{"name", asked.name}, {"change", change}};
  for (const char* key : {"wall_median_mm", "wall_p95_mm", "wall_over_5", "skin_p95_mm",
                          "nipple_mm", "nipple_sd_mm", "lesion_mm", "left_out", "left_out_of_all",
                          "breast_ratio", "gland_ratio", "status", "doubted", "unsaid", "reason"})
    row[key] = nullptr;
  return row;
}

void say_status(json& row, const Found& found) {
  row["status"] = found.sidecar.at("status");
  row["nipple_sd_mm"] = found.sidecar.at("quality").at("nipple_sd_mm");
  row["doubted"] = doubts_of(found.sidecar);
}

void compare_surfaces(json& row, const Found& first, const Found& after,
                      const ChangedMri& changed) {
  const Mask& labels = first.segmentation.labels;
  const Mask seen = seen_on(labels, after.segmentation.labels, changed);
  const BreastRegion inside = shrunk(first.segmentation.region, kOffEdges_mm);
  const auto wall =
      border_moves(border(labels, label::muscle, 1), border(seen, label::muscle, 1), inside);
  const auto skin =
      border_moves(border(labels, label::air, -1), border(seen, label::air, -1), inside);
  if (wall.empty() || skin.empty()) throw std::runtime_error("no wall or no skin in the region");
  row["wall_median_mm"] = at_share(wall, 0.5);
  row["wall_p95_mm"] = at_share(wall, 0.95);
  row["wall_over_5"] =
      static_cast<double>(wall.end() - std::upper_bound(wall.begin(), wall.end(), kWallMoved_mm)) /
      static_cast<double>(wall.size());
  row["skin_p95_mm"] = at_share(skin, 0.95);
}

void compare_points(json& row, const Segmentation& first, const Segmentation& after,
                    const ChangedMri& changed) {
  row["nipple_mm"] = (changed.changed_from_first(first.nipple_in_lps) - after.nipple_in_lps).norm();
  double worst = 0;
  for (std::size_t n = 0; n < std::min(first.lesions.size(), after.lesions.size()); ++n)
    worst = std::max(worst, (changed.changed_from_first(first.lesions[n].centroid_in_lps) -
                             after.lesions[n].centroid_in_lps)
                                .norm());
  if (!first.lesions.empty()) row["lesion_mm"] = worst;
}

std::vector<std::string> moved_unsaid(const json& row, const json& first_doubts) {
  const auto says = [&](const std::string& part) {
    for (const json* doubts : {&first_doubts, &row.at("doubted")})
      for (const json& what : *doubts)
        if (what.get<std::string>().find(part) != std::string::npos) return true;
    return false;
  };
  const auto beyond = [&](const char* key, double limit) {
    return !row.at(key).is_null() && row.at(key).get<double>() > limit;
  };
  std::vector<std::string> unsaid;
  if (beyond("wall_p95_mm", kWallMoved_mm) && !says("wall")) unsaid.push_back("wall");
  if (beyond("nipple_mm", kNippleMoved_mm) && !says("nipple")) unsaid.push_back("nipple");
  if (beyond("lesion_mm", kLesionMoved_mm) && !says("lesion")) unsaid.push_back("lesion");
  if (beyond("left_out", kLeftOut) && !says("region")) unsaid.push_back("region");
  return unsaid;
}

void compare_change(json& row, const Found& first, const Found& after, const ChangedMri& changed) {
  compare_surfaces(row, first, after, changed);
  compare_points(row, first.segmentation, after.segmentation, changed);
  const LeftOut left = left_out(first.segmentation, after.segmentation, changed);
  row["left_out"] = left.of_hanging;
  row["left_out_of_all"] = left.of_all;
  const auto ratio = [&](const char* key) {
    return after.sidecar.at("quality").at(key).get<double>() /
           first.sidecar.at("quality").at(key).get<double>();
  };
  row["breast_ratio"] = ratio("breast_volume_ml");
  row["gland_ratio"] = ratio("fibroglandular_ml");
  row["unsaid"] = moved_unsaid(row, doubts_of(first.sidecar));
}

RealBreast changed_breast(RealBreast breast, const ChangedMri& changed) {
  if (changed.mirrored) breast.side = breast.side == Side::left ? Side::right : Side::left;
  for (Eigen::Vector3d& x : breast.lesions) x = changed.changed_from_first(x);
  return breast;
}

}  // namespace

void add_segmentation_change_rows(const SegmentationChangeCase& asked,
                                  const std::function<void(const json&)>& add) {
  json none = new_change_row(asked, "none");
  try {
    const RealBreast breast = breast_of(asked.patient_toml);
    const Volume<float> image = read_mri(breast.image).image;
    const Found first = segmented(breast, image, asked.folder / "none");
    say_status(none, first);
    add(none);
    for (const MriChange& change : asked.changes) {
      json row = new_change_row(asked, change.name);
      try {
        const ChangedMri changed = change.apply(image, breast.side);
        const Found after =
            segmented(changed_breast(breast, changed), changed.image, asked.folder / change.name);
        say_status(row, after);
        compare_change(row, first, after, changed);
      } catch (const std::exception& error) {
        row["reason"] = error.what();
      }
      add(row);
    }
  } catch (const std::exception& error) {
    none["reason"] = error.what();
    add(none);
  }
}

std::string segmentation_changes_summary(const json& rows) {
  std::map<std::string, std::vector<const json*>> by_change;
  for (const json& row : rows)
    if (row.at("change") != "none") by_change[row.at("change")].push_back(&row);
  std::string text;
  for (const auto& [change, of_it] : by_change) {
    std::vector<double> walls;
    int failed = 0, unsaid = 0;
    for (const json* row : of_it) {
      failed += !row->at("reason").is_null();
      unsaid += !row->at("unsaid").is_null() && !row->at("unsaid").empty();
      if (!row->at("wall_p95_mm").is_null()) walls.push_back(row->at("wall_p95_mm"));
    }
    std::sort(walls.begin(), walls.end());
    char line[200];
    std::snprintf(line, sizeof line,
                  "  %s: %zu cases, wall moved by %.1f mm (median of 95 %%), %.1f at worst; "
                  "something moved unsaid in %d, %d failed\n",
                  change.c_str(), of_it.size(), walls.empty() ? 0 : median_of_sorted(walls),
                  walls.empty() ? 0 : walls.back(), unsaid, failed);
    text += line;
  }
  return text;
}

}  // namespace mammotwin
