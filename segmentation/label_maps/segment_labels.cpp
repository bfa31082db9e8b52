#include "segmentation/label_maps/segment_labels.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "segmentation/body/midline.h"
#include "segmentation/files/read_labels.h"
#include "segmentation/label_maps/fill_behind_muscle.h"
#include "segmentation/label_maps/segment_names.h"
#include "segmentation/lesion/lesion_seed.h"
#include "segmentation/lesion/measure_lesions.h"

namespace mammotwin {
namespace {

/// The lesions' side, where all are on one.
Side side_of_lesions(const std::vector<Eigen::Vector3d>& places, std::optional<double> midline,
                     const std::string& file) {
  std::size_t left = 0;
  for (const Eigen::Vector3d& x : places) left += x.x() > midline.value_or(0);
  if (midline && !places.empty() && (left == 0 || left == places.size()))
    return left ? Side::left : Side::right;
  throw std::runtime_error(file + ": the side is not clear: " + std::to_string(left) +
                           " lesion(s) on the left and " + std::to_string(places.size() - left) +
                           " on the right" +
                           (midline ? "" : ", and no valley between two breasts") +
                           "; set side = \"left\" or \"right\" in patient.toml");
}

/// Number of the lesion label nearest to a point, and its distance [mm].
struct Nearest {
  std::uint8_t value = 0;
  double distance = std::numeric_limits<double>::infinity();
};

Nearest nearest_lesion(const Volume<std::uint8_t>& labels, const Eigen::Vector3d& x) {
  Nearest best;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        if (!label::is_lesion(labels(i, j, k))) continue;
        const double d = (labels.position(i, j, k) - x).norm();
        if (d < best.distance) best = {labels(i, j, k), d};
      }
  return best;
}

void paint(const PlacedSeed& seed, std::uint8_t value, MappedLabels& mapped) {
  std::size_t painted = 0;
  Volume<std::uint8_t>& labels = mapped.labels;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        if (!label::is_breast(labels(i, j, k)) || !seed.holds(labels.position(i, j, k))) continue;
        labels(i, j, k) = value;
        mapped.fractions(i, j, k) = {0, 0, 1};
        ++painted;
      }
  if (painted == 0)
    throw std::runtime_error("lesion " + seed.id +
                             " lies outside the breast; expected a place "
                             "between skin and chest wall in LPS [mm] (is it in RAS?)");
}

/// Renumbers the lesions left on this side from `label::lesion` up, in order of their labels.
std::vector<std::uint8_t> renumber(Volume<std::uint8_t>& labels) {
  std::array<bool, 256> present{};
  for (const std::uint8_t value : labels.values) present[value] = true;
  std::vector<std::uint8_t> new_value(256, 0);
  std::uint8_t next = label::lesion;
  for (int value = label::lesion; value < 256; ++value)
    if (present[value]) new_value[value] = next++;
  for (std::uint8_t& value : labels.values)
    if (label::is_lesion(value)) value = new_value[value];
  return new_value;
}

std::uint8_t first_free_lesion(const Volume<std::uint8_t>& labels) {
  std::uint8_t highest = label::lesion - 1;
  for (const std::uint8_t value : labels.values) highest = std::max(highest, value);
  if (highest == 255) throw std::runtime_error("the label map holds too many lesions (over 245)");
  return static_cast<std::uint8_t>(highest + 1);
}

/// Lesion labels with the ids that seeds give them.
void name_lesions(const std::vector<PlacedSeed>& seeds, MappedLabels& mapped,
                  std::vector<std::pair<std::uint8_t, std::string>>& names) {
  for (const PlacedSeed& seed : seeds) {
    if (seed.radius_mm || seed.mask) {
      names.emplace_back(first_free_lesion(mapped.labels), seed.id);
      paint(seed, names.back().first, mapped);
      continue;
    }
    const Nearest nearest = nearest_lesion(mapped.labels, seed.point_in_lps);
    if (nearest.distance > nearest_lesion_mm)
      throw std::runtime_error("lesion " + seed.id +
                               " is named by a point, but the label map has "
                               "no lesion within 10 mm of it; expected one (or give radius_mm)");
    names.emplace_back(nearest.value, seed.id);
  }
}

/// What the values of the map mean: as given, by the names of segments, or the project's own.
NamedSegments segments_of(const SegmentInput& input) {
  if (!input.label_values.empty()) return {input.label_values, {}};
  try {
    NamedSegments named = read_segment_names(*input.label_map);
    if (named.values.empty()) named.values = own_label_values();
    return named;
  } catch (const std::exception& error) {
    throw std::runtime_error(input.label_map->string() + ": " + error.what());
  }
}

/// A lesion is called as the segment was that holds most of it.
std::vector<std::pair<std::uint8_t, std::string>> names_by_segment(
    const NamedSegments& named, const Volume<std::uint16_t>& foreign,
    const Volume<std::uint8_t>& labels) {
  std::map<std::uint8_t, std::map<std::uint16_t, std::size_t>> votes;
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    if (label::is_lesion(labels.values[v]) && named.lesions.count(foreign.values[v]))
      ++votes[labels.values[v]][foreign.values[v]];
  std::vector<std::pair<std::uint8_t, std::string>> names;
  for (const auto& [value, counts] : votes) {
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    const std::string& name = named.lesions.at(most->first);
    const auto before = std::count_if(names.begin(), names.end(), [&](const auto& other) {
      return named.lesions.at(most->first) == other.second.substr(0, name.size());
    });
    names.emplace_back(value, before > 0 ? name + "-" + std::to_string(before + 1) : name);
  }
  return names;
}

std::string sentence(const LesionSpecks& specks) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << specks.parts
       << (specks.parts == 1 ? " part" : " parts") << " of lesion labels, "
       << (specks.parts == 1 ? "of " : "the largest of ") << specks.largest_ml << " ml at ("
       << std::setprecision(0) << specks.largest_in_lps.x() << ", " << specks.largest_in_lps.y()
       << ", " << specks.largest_in_lps.z()
       << ") mm LPS, counted as fibroglandular tissue: smaller than a ball of 5 mm beside a larger "
          "part of their label, or than 0.02 ml (to keep one, give it in [[lesions]] by "
          "point_lps_mm and radius_mm)";
  return text.str();
}

}  // namespace

SegmentResult segment_labels(const SegmentInput& input) {
  const std::string file = input.label_map->string();
  const NamedSegments named = segments_of(input);
  const Volume<std::uint16_t> foreign = read_labels(*input.label_map);
  std::vector<PlacedSeed> seeds;
  for (const LesionSeed& seed : input.lesions) seeds.push_back(place_seed(seed));
  std::vector<Eigen::Vector3d> places, named_by_point;
  for (const PlacedSeed& seed : seeds) {
    places.push_back(seed.point_in_lps);
    if (!seed.radius_mm && !seed.mask) named_by_point.push_back(seed.point_in_lps);
  }
  MappedLabels mapped = map_labels(foreign, named.values, named_by_point);

  const std::optional<double> midline = find_midline(mapped.labels);
  if (places.empty())
    for (const Lesion& lesion : measure_lesions(mapped.labels))
      places.push_back(lesion.centroid_in_lps);
  const Side side = input.side ? *input.side : side_of_lesions(places, midline, file);
  if (midline) keep_side(mapped.labels, *midline, side);
  fill_behind_muscle(mapped.labels);

  auto names = names_by_segment(named, foreign, mapped.labels);
  name_lesions(seeds, mapped, names);
  const std::vector<std::uint8_t> new_value = renumber(mapped.labels);

  SegmentResult result;
  Segmentation& s = result.segmentation;
  s.labels = std::move(mapped.labels);
  s.fractions = std::move(mapped.fractions);
  s.region.side = side;
  s.lesions = measure_lesions(s.labels);
  for (const auto& [value, id] : names) s.lesions[new_value[value] - label::lesion].id = id;
  result.files = {*input.label_map};
  result.quality.contrast = "labels";
  if (mapped.specks.parts > 0) result.quality.notes.push_back(sentence(mapped.specks));
  return result;
}

}  // namespace mammotwin
