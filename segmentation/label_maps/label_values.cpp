#include "segmentation/label_maps/label_values.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "segmentation/image/components.h"

namespace mammotwin {
namespace {

using Word = std::pair<ForeignTissue, const char*>;
constexpr std::array<Word, 7> words{{{ForeignTissue::air, "air"},
                                     {ForeignTissue::skin, "skin"},
                                     {ForeignTissue::fat, "fat"},
                                     {ForeignTissue::fibroglandular, "fibroglandular"},
                                     {ForeignTissue::transition, "transition"},
                                     {ForeignTissue::muscle, "muscle"},
                                     {ForeignTissue::lesion, "lesion"}}};
constexpr double least_lesion_ml = 0.02, focus_ml = 0.0654;  // the latter a ball of 5 mm

ForeignTissue tissue_of(const LabelValues& values, std::uint16_t value) {
  if (const auto found = values.find(value); found != values.end()) return found->second;
  if (value == 0) return ForeignTissue::air;
  std::string known;
  for (const auto& [v, tissue] : values)
    known += (known.empty() ? "" : ", ") + std::to_string(v) + " " + to_string(tissue);
  throw std::invalid_argument("the label map holds the value " + std::to_string(value) +
                              ", which labels.values does not name; expected one of " + known +
                              " (add it)");
}

std::uint8_t own_label(ForeignTissue tissue) {
  switch (tissue) {
    case ForeignTissue::air:
      return label::air;
    case ForeignTissue::skin:
      return label::skin;
    case ForeignTissue::fat:
      return label::fat;
    case ForeignTissue::muscle:
      return label::muscle;
    default:
      return label::fibroglandular;  // transition and lesions are settled afterwards
  }
}

/// Transition voxels go to the interior tissue of most of their 26 neighbours.
void settle_transition(const Volume<std::uint8_t>& transition, Volume<std::uint8_t>& labels) {
  const Volume<std::uint8_t> before = labels;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        if (!transition(i, j, k)) continue;
        int fat = 0, gland = 0;
        for (int c = -1; c <= 1; ++c)
          for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a) {
              if (!labels.contains(i + a, j + b, k + c)) continue;
              if (transition(i + a, j + b, k + c)) continue;
              fat += before(i + a, j + b, k + c) == label::fat;
              gland += before(i + a, j + b, k + c) == label::fibroglandular;
            }
        labels(i, j, k) = gland > fat ? label::fibroglandular : label::fat;
      }
}

/// Whether each part of lesion labels counts as a lesion.
std::vector<bool> lesions_among(const Components& parts, const Volume<std::uint16_t>& foreign,
                                const std::vector<Eigen::Vector3d>& named) {
  std::vector<double> least_ml(parts.sizes.size(), focus_ml);
  std::map<std::uint16_t, std::map<std::int32_t, std::size_t>> voxels_of;
  for (std::size_t v = 0; v < foreign.values.size(); ++v)
    if (const std::int32_t part = parts.ids.values[v]) ++voxels_of[foreign.values[v]][part];
  for (const auto& [value, voxels] : voxels_of) {
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    least_ml[std::max_element(voxels.begin(), voxels.end(), fewer)->first] = least_lesion_ml;
  }
  std::vector<bool> is_lesion;
  for (std::size_t part = 0; part < parts.sizes.size(); ++part)
    is_lesion.push_back(parts.sizes[part] * foreign.voxel_volume() / 1000 >= least_ml[part]);
  for (const Eigen::Vector3d& x : named) {
    double nearest_mm = nearest_lesion_mm;
    std::int32_t nearest = 0;
    bool has_lesion = false;
    for (std::size_t v = 0; v < foreign.values.size(); ++v)
      if (const std::int32_t part = parts.ids.values[v])
        if (const double mm = (foreign.position(v) - x).norm(); mm <= nearest_lesion_mm) {
          has_lesion = has_lesion || is_lesion[part];
          if (mm <= nearest_mm) nearest_mm = mm, nearest = part;
        }
    if (nearest != 0 && !has_lesion) is_lesion[nearest] = true;
  }
  return is_lesion;
}

/// Numbers the lesions, largest first.
void label_lesions(const Volume<std::uint8_t>& lesion, const Volume<std::uint16_t>& foreign,
                   const std::vector<Eigen::Vector3d>& named, MappedLabels& out) {
  const Components parts = connected_components(lesion);
  const std::vector<bool> is_lesion = lesions_among(parts, foreign, named);
  std::vector<std::int32_t> order(parts.sizes.size() - 1);
  std::iota(order.begin(), order.end(), 1);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return parts.sizes[a] > parts.sizes[b]; });
  std::vector<std::uint8_t> label_of(parts.sizes.size(), label::fibroglandular);
  int next = label::lesion;
  std::int32_t largest_speck = 0;
  for (const std::int32_t part : order) {
    if (is_lesion[part] && next < 256) {
      label_of[part] = static_cast<std::uint8_t>(next++);
    } else if (++out.specks.parts == 1) {
      largest_speck = part;
      out.specks.largest_ml = parts.sizes[part] * foreign.voxel_volume() / 1000;
    }
  }
  for (std::size_t v = 0; v < lesion.values.size(); ++v)
    if (lesion.values[v]) out.labels.values[v] = label_of[parts.ids.values[v]];
  const auto& ids = parts.ids.values;
  if (largest_speck != 0)
    out.specks.largest_in_lps = foreign.position(
        static_cast<std::size_t>(std::find(ids.begin(), ids.end(), largest_speck) - ids.begin()));
}

}  // namespace

std::string to_string(ForeignTissue tissue) {
  for (const auto& [value, word] : words)
    if (value == tissue) return word;
  throw std::logic_error("unnamed tissue");
}

ForeignTissue foreign_tissue(const std::string& word) {
  std::string known;
  for (const auto& [value, name] : words) {
    if (word == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw std::invalid_argument("\"" + word + "\" is no tissue; expected one of " + known);
}

LabelValues own_label_values() {
  LabelValues values{{label::air, ForeignTissue::air},
                     {label::skin, ForeignTissue::skin},
                     {label::fat, ForeignTissue::fat},
                     {label::fibroglandular, ForeignTissue::fibroglandular},
                     {label::muscle, ForeignTissue::muscle}};
  for (int n = label::lesion; n < 256; ++n)
    values[static_cast<std::uint16_t>(n)] = ForeignTissue::lesion;
  return values;
}

MappedLabels map_labels(const Volume<std::uint16_t>& foreign, const LabelValues& values,
                        const std::vector<Eigen::Vector3d>& named) {
  MappedLabels out{foreign.like<std::uint8_t>(0), foreign.like<Fractions>(), {}};
  auto transition = foreign.like<std::uint8_t>(0), lesion = transition;
  std::array<int, 65536> cache;
  cache.fill(-1);
  for (std::size_t v = 0; v < foreign.values.size(); ++v) {
    const std::uint16_t value = foreign.values[v];
    if (cache[value] < 0) cache[value] = static_cast<int>(tissue_of(values, value));
    const auto tissue = static_cast<ForeignTissue>(cache[value]);
    out.labels.values[v] = own_label(tissue);
    transition.values[v] = tissue == ForeignTissue::transition;
    lesion.values[v] = tissue == ForeignTissue::lesion;
  }
  settle_transition(transition, out.labels);
  label_lesions(lesion, foreign, named, out);
  for (std::size_t v = 0; v < foreign.values.size(); ++v)
    out.fractions.values[v] =
        transition.values[v] ? Fractions{0.5F, 0.5F, 0} : pure_fractions(out.labels.values[v]);
  return out;
}

}  // namespace mammotwin
