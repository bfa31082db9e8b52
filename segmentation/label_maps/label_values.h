#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "segmentation/image/volume.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// What a value of a label map made elsewhere means.
enum class ForeignTissue { air, skin, fat, fibroglandular, transition, muscle, lesion };

/// The word used in patient.toml: "air", "skin", ... "transition" (half fat, half fibroglandular).
std::string to_string(ForeignTissue tissue);
/// Throws std::invalid_argument listing the words where `word` is none of them.
ForeignTissue foreign_tissue(const std::string& word);

/// From the values of a label map to tissues. Every value in the map must be named (0 is air
/// where nothing else is said). Connected parts of values named `lesion` are one lesion
/// each.
using LabelValues = std::map<std::uint16_t, ForeignTissue>;

/// Values of the project's own maps (segmentation.h).
LabelValues own_label_values();

/// Parts of lesion labels that count as no lesion: scattered voxels beside what was marked.
struct LesionSpecks {
  std::size_t parts = 0;
  double largest_ml = 0;
  Eigen::Vector3d largest_in_lps = Eigen::Vector3d::Zero();  ///< its first voxel's centre
};

/// Labels as in segmentation.h, and fractions, from a foreign map.
struct MappedLabels {
  Volume<std::uint8_t> labels;
  Volume<Fractions> fractions;
  LesionSpecks specks;
};

/// A part of lesion labels is a lesion if it is as large as a ball of 5 mm (less is a focus: ACR
/// BI-RADS MRI, 2013), or is the largest of a value and of 0.02 ml or more, or the nearest to a
/// point in `named` that has no such lesion within 10 mm, if it is within that itself. Lesions get
/// labels from `label::lesion` up, the largest first; other parts become fibroglandular. Transition
/// voxels are labelled fibroglandular where most neighbours that are not transition are, else fat,
/// and have the fraction one half. Throws std::invalid_argument if the map holds a value that is
/// not named.
MappedLabels map_labels(const Volume<std::uint16_t>& foreign, const LabelValues& values,
                        const std::vector<Eigen::Vector3d>& named = {});

/// A seed names a lesion that a label map has within this distance of it.
constexpr double nearest_lesion_mm = 10;

}  // namespace mammotwin
