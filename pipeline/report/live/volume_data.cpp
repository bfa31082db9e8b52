#include "pipeline/report/live/volume_data.h"

#include <cmath>

#include "pipeline/report/drawing/breast_window.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/live/deflated.h"

namespace mammotwin {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

// 8 bit of noise deflate to about 6/8: 6 MB as base64. Mammograms in their own pixels take as much.
constexpr double kMostVoxels = 6e6, kMostVoxelsBesideMammograms = 3e6;

/// The label map's voxels in the box, thinned out until there are few enough.
Volume<std::uint8_t> window_grid(const Volume<std::uint8_t>& labels, const Eigen::AlignedBox3d& box,
                                 double most_voxels) {
  const Eigen::Vector3i first = labels.index(box.min()).array().ceil().cast<int>().max(0);
  const Eigen::Vector3i last =
      labels.index(box.max()).cast<int>().cwiseMin(labels.size - Eigen::Vector3i::Ones());
  const Eigen::Vector3i size = last - first + Eigen::Vector3i::Ones();
  Eigen::Vector3i every = Eigen::Vector3i::Ones();
  const auto count = [&] {
    return ((size - Eigen::Vector3i::Ones()).cwiseQuotient(every) + Eigen::Vector3i::Ones()).eval();
  };
  while (count().cast<double>().prod() > most_voxels) {
    int finest = 0;
    labels.spacing.cwiseProduct(every.cast<double>()).minCoeff(&finest);
    ++every[finest];
  }
  return Volume<std::uint8_t>(count(), labels.spacing.cwiseProduct(every.cast<double>()),
                              labels.position(first.x(), first.y(), first.z()), label::air);
}

/// Fills a grid of bytes with `value` at its voxels' centres.
template <class Value>
Bytes sampled(const Volume<std::uint8_t>& grid, Value value) {
  Bytes bytes;
  bytes.reserve(grid.values.size());
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i) bytes.push_back(value(grid.position(i, j, k)));
  return bytes;
}

json list_of(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

json colour_of(std::uint8_t label) {
  const Colour c = palette::of_label(label);
  return {std::lround(255 * c.red), std::lround(255 * c.green), std::lround(255 * c.blue)};
}

json label_list(const std::vector<Landmark>& lesions) {
  json list = json::array();
  const std::pair<std::uint8_t, const char*> tissues[] = {{label::skin, "skin"},
                                                          {label::fat, "fat"},
                                                          {label::fibroglandular, "fibroglandular"},
                                                          {label::muscle, "muscle"}};
  for (const auto& [value, name] : tissues)
    list.push_back({{"value", value}, {"name", name}, {"colour", colour_of(value)}});
  for (std::size_t n = 0; n < lesions.size(); ++n)
    list.push_back({{"value", label::lesion + n},
                    {"name", "lesion " + lesions[n].id},
                    {"colour", colour_of(label::lesion)}});
  return list;
}

json place_list(const PatientResults& results) {
  json list = json::array();
  for (const Landmark& lesion : results.lesions())
    list.push_back({{"name", "Lesion " + lesion.id}, {"at", list_of(lesion.prone_in_lps)}});
  if (const auto nipple = results.nipple())
    list.push_back({{"name", "Nipple"}, {"at", list_of(*nipple)}});
  return list;
}

}  // namespace

json volume_data(const PatientResults& results) {
  const Volume<std::uint8_t>& labels = results.segmentation->labels;
  const Eigen::AlignedBox3d box = breast_box(results);
  const Volume<std::uint8_t> grid = window_grid(
      labels, box, results.mammograms.empty() ? kMostVoxels : kMostVoxelsBesideMammograms);
  json data = {{"size", {grid.size.x(), grid.size.y(), grid.size.z()}},
               {"spacing", list_of(grid.spacing)},
               {"origin", list_of(grid.origin)},
               {"tissues", label_list(results.lesions())},
               {"mark", colour_of(label::lesion)},
               {"curve", palette::css(palette::own_mark)},
               {"places", place_list(results)}};
  data["labels"] = deflated(
      sampled(grid, [&](const Eigen::Vector3d& x) { return nearest(labels, x, label::air); }));
  if (!results.mri) return data;
  const GreyWindow window = grey_window(*results.mri, box);
  data["grey"] = deflated(sampled(grid, [&](const Eigen::Vector3d& x) {
    return static_cast<std::uint8_t>(std::lround(255 * window.of(nearest(*results.mri, x, 0.0f))));
  }));
  return data;
}

}  // namespace mammotwin
