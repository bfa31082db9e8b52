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
constexpr int most_lesions = 256 - label::lesion;

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

/// Numbers the lesions, largest first.
void label_lesions(const Volume<std::uint8_t>& lesion, double least_ml,
                   Volume<std::uint8_t>& labels) {
  const Components parts = connected_components(lesion);
  std::vector<std::int32_t> order(parts.sizes.size() - 1);
  std::iota(order.begin(), order.end(), 1);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return parts.sizes[a] > parts.sizes[b]; });
  std::vector<std::uint8_t> label_of(parts.sizes.size(), label::fibroglandular);
  for (std::size_t n = 0; n < order.size() && n < most_lesions; ++n)
    if (parts.sizes[order[n]] * labels.voxel_volume() / 1000 >= least_ml)
      label_of[order[n]] = static_cast<std::uint8_t>(label::lesion + n);
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    if (lesion.values[v]) labels.values[v] = label_of[parts.ids.values[v]];
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
                        double least_lesion_ml) {
  MappedLabels out{foreign.like<std::uint8_t>(0), foreign.like<Fractions>()};
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
  label_lesions(lesion, least_lesion_ml, out.labels);
  for (std::size_t v = 0; v < foreign.values.size(); ++v)
    out.fractions.values[v] =
        transition.values[v] ? Fractions{0.5F, 0.5F, 0} : pure_fractions(out.labels.values[v]);
  return out;
}

}  // namespace mammotwin
