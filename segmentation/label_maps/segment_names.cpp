#include "segmentation/label_maps/segment_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <stdexcept>

#include "segmentation/files/read_raw_image.h"

namespace mammotwin {
namespace {

using Keys = std::map<std::string, std::string>;

struct NamedTissue {
  const char* part;
  ForeignTissue tissue;
};

/// Parts of names, then SNOMED codes; the first that fits counts.
constexpr std::array<NamedTissue, 17> named_tissues{{{"lesion", ForeignTissue::lesion},
                                                     {"tumour", ForeignTissue::lesion},
                                                     {"tumor", ForeignTissue::lesion},
                                                     {"mass", ForeignTissue::lesion},
                                                     {"cancer", ForeignTissue::lesion},
                                                     {"skin", ForeignTissue::skin},
                                                     {"gland", ForeignTissue::fibroglandular},
                                                     {"muscle", ForeignTissue::muscle},
                                                     {"pectoral", ForeignTissue::muscle},
                                                     {"chest wall", ForeignTissue::muscle},
                                                     {"fat", ForeignTissue::fat},
                                                     {"adipose", ForeignTissue::fat},
                                                     {"^52988006^", ForeignTissue::lesion},
                                                     {"^39937001^", ForeignTissue::skin},
                                                     {"^248300009^", ForeignTissue::fat},
                                                     {"^71616004^", ForeignTissue::muscle},
                                                     {"background", ForeignTissue::air}}};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::optional<ForeignTissue> tissue_in(const std::string& text) {
  for (const NamedTissue& word : named_tissues)
    if (lower(text).find(word.part) != std::string::npos) return word.tissue;
  return std::nullopt;
}

std::string value_of(const Keys& keys, const std::string& key) {
  const auto found = keys.find(key);
  return found == keys.end() ? "" : found->second;
}

ForeignTissue tissue_of(const std::string& name, const std::string& tags, std::uint16_t value) {
  if (const auto tissue = tissue_in(name)) return *tissue;
  if (const auto tissue = tissue_in(tags)) return *tissue;
  const LabelValues own = own_label_values();
  if (const auto known = own.find(value); known != own.end()) return known->second;
  throw std::runtime_error(
      "the segment \"" + name + "\" has neither a known name nor a known value (" +
      std::to_string(value) +
      "); expected skin, fat, fibroglandular, muscle or lesion in its name, or "
      "its value under [labels] in patient.toml");
}

}  // namespace

NamedSegments read_segment_names(const std::filesystem::path& path) {
  Keys keys;
  read_raw_image(path, &keys);
  NamedSegments segments;
  for (int n = 0;; ++n) {
    const std::string prefix = "Segment" + std::to_string(n) + "_";
    const std::string number = value_of(keys, prefix + "LabelValue");
    if (number.empty()) return segments;
    const std::string name = value_of(keys, prefix + "Name");
    if (const std::string layer = value_of(keys, prefix + "Layer"); !layer.empty() && layer != "0")
      throw std::runtime_error("the segment \"" + name +
                               "\" lies in a second layer; expected segments that do not overlap "
                               "(in 3D Slicer: Masking, overwrite all segments)");
    int value = -1;
    try {
      value = std::stoi(number);
    } catch (const std::exception&) {
    }
    if (value < 1 || value > 65535)
      throw std::runtime_error("the segment \"" + name + "\" has the value " + number +
                               "; expected 1 to 65535");
    const auto label = static_cast<std::uint16_t>(value);
    segments.values[label] = tissue_of(name, value_of(keys, prefix + "Tags"), label);
    if (segments.values[label] == ForeignTissue::lesion) segments.lesions[label] = name;
  }
}

}  // namespace mammotwin
