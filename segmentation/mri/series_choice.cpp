#include "segmentation/mri/series_choice.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

constexpr double least_cover_mm = 100;  // of a breast with its fold
constexpr double most_voxel_mm = 2.4;
constexpr double as_fine = 1.1;  // times the finest voxel

double volume(const SeriesRow& row) { return row.voxel_mm.prod(); }

/// Leaves out the rows that do not serve, unless none does.
class Sieve {
 public:
  explicit Sieve(std::vector<SeriesRow>& rows) : rows_(rows) {
    for (std::size_t n = 0; n < rows.size(); ++n) left_.push_back(n);
  }

  void keep(const std::function<bool(const SeriesRow&)>& serves, const std::string& why_not) {
    const auto holds = [&](std::size_t n) { return serves(rows_[n]); };
    if (std::none_of(left_.begin(), left_.end(), holds)) return;
    std::erase_if(left_, [&](std::size_t n) {
      if (holds(n)) return false;
      rows_[n].reason = why_not;
      return true;
    });
  }

  double least_volume() const {
    double least = volume(rows_[left_.front()]);
    for (const std::size_t n : left_) least = std::min(least, volume(rows_[n]));
    return least;
  }
  std::size_t most_slices() const {
    std::size_t most = 0;
    for (const std::size_t n : left_) most = std::max(most, rows_[n].slices);
    return most;
  }

  /// What is left, by time.
  std::vector<std::size_t> in_time() const {
    std::vector<std::size_t> order = left_;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return rows_[a].seconds < rows_[b].seconds;
    });
    return order;
  }

 private:
  std::vector<SeriesRow>& rows_;
  std::vector<std::size_t> left_;
};

}  // namespace

std::size_t choose_series_row(std::vector<SeriesRow>& rows) {
  Sieve sieve(rows);
  sieve.keep([](const SeriesRow& r) { return !r.is_computed; }, "computed from other images");
  sieve.keep([](const SeriesRow& r) { return r.covers_mm >= least_cover_mm; },
             "covers less than 100 mm of the body");
  sieve.keep([](const SeriesRow& r) { return r.voxel_mm.maxCoeff() <= most_voxel_mm; },
             "voxels of over 2.4 mm lose the skin");
  sieve.keep(
      [](const SeriesRow& r) {
        return !r.look || r.look->signal_to_noise >= limits::signal_to_noise;
      },
      "noisy: fat is less than 8 times as bright as noise");
  sieve.keep([](const SeriesRow& r) { return r.phase > 0; },
             "not of the dynamic study's geometry: lesions may have washed out");
  const double least = sieve.least_volume();
  sieve.keep([&](const SeriesRow& r) { return volume(r) <= as_fine * least; },
             "another has finer voxels");
  const std::size_t most = sieve.most_slices();
  sieve.keep([&](const SeriesRow& r) { return r.slices == most; }, "another has more slices");
  const std::vector<std::size_t> order = sieve.in_time();
  const std::size_t chosen = order.size() > 1 ? 1 : 0;
  for (std::size_t n = 0; n < order.size(); ++n)
    rows[order[n]].reason =
        n < chosen ? "before the contrast agent, if one was given: may serve as mri.pre"
                   : "later: lesions wash out";
  SeriesRow& row = rows[order[chosen]];
  row.is_read = true;
  row.reason =
      order.size() > 1
          ? "the second in time of " + std::to_string(order.size()) +
                " that serve equally (in a dynamic study the first after the contrast agent)"
          : "the one that serves";
  return order[chosen];
}

nlohmann::json to_json(const std::vector<SeriesRow>& rows) {
  nlohmann::json table = nlohmann::json::array();
  for (const SeriesRow& r : rows)
    table.push_back(
        {{"series", r.number},
         {"slices", r.slices},
         {"voxel_mm", {r.voxel_mm.x(), r.voxel_mm.y(), r.voxel_mm.z()}},
         {"covers_mm", r.covers_mm},
         {"seconds_after_first", r.seconds},
         {"phase", r.phase > 0 ? nlohmann::json(r.phase) : nlohmann::json()},
         {"signal_to_noise", r.look ? nlohmann::json(r.look->signal_to_noise) : nlohmann::json()},
         {"skin_over_fat", r.look ? nlohmann::json(r.look->skin_over_fat) : nlohmann::json()},
         {"read", r.is_read},
         {"reason", r.reason}});
  return table;
}

}  // namespace mammotwin
