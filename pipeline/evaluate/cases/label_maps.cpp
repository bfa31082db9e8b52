#include "pipeline/evaluate/cases/label_maps.h"

#include <algorithm>

namespace mammotwin {

LabelValues label_map_values() {
  using enum ForeignTissue;
  return {{0, air},    {1, fat},    {2, fibroglandular}, {3, skin},
          {4, muscle}, {5, lesion}, {6, lesion},         {7, transition}};
}

std::vector<std::filesystem::path> sorted_entries(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::vector<LabelMapBreast> label_map_breasts(const std::filesystem::path& cases) {
  std::vector<LabelMapBreast> found;
  for (const auto& path : sorted_entries(cases / "label_maps")) {
    const std::string file = path.filename().string();
    if (!file.ends_with("_labels.nii.gz")) continue;
    for (const Side side : {Side::left, Side::right})
      found.push_back({file.substr(0, file.find("_labels")), side, path});
  }
  return found;
}

}  // namespace mammotwin
