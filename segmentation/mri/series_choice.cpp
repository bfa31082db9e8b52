#include "segmentation/mri/series_choice.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

constexpr double least_cover_mm = 100;  // of a breast with its fold
constexpr double most_voxel_mm = 2.4;
constexpr double most_compared_voxel_mm = 4;  // the wall is seen without the skin
constexpr double as_fine = 1.1;               // times the finest voxel

bool covers(const SeriesRow& r) { return r.covers_mm >= least_cover_mm; }
bool is_fine(const SeriesRow& r) { return r.voxel_mm.maxCoeff() <= most_voxel_mm; }
bool is_noisy(const SeriesRow& r) {
  return r.look && r.look->signal_to_noise < limits::signal_to_noise;
}
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
  sieve.keep(covers, "covers less than 100 mm of the body");
  sieve.keep(is_fine, "voxels of over 2.4 mm lose the skin");
  sieve.keep([](const SeriesRow& r) { return !is_noisy(r); },
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
        n < chosen
            ? "before the contrast agent, if one was given: used beside the one that is read "
              "where that shows uptake and the patient lay still"
            : "later: lesions wash out";
  SeriesRow& row = rows[order[chosen]];
  row.is_read = true;
  if (chosen > 0) rows[order[0]].is_before_agent = rows[order[0]].phase > 0 && row.phase > 0;
  row.reason =
      order.size() > 1
          ? "the second in time of " + std::to_string(order.size()) +
                " that serve equally (in a dynamic study the first after the contrast agent)"
          : "the one that serves";
  return order[chosen];
}

std::optional<std::size_t> choose_compared_row(std::vector<SeriesRow>& rows, std::size_t read) {
  const auto serves = [](const SeriesRow& r) {
    return !r.is_computed && covers(r) && r.voxel_mm.maxCoeff() <= most_compared_voxel_mm &&
           r.look && !is_noisy(r);
  };
  const auto suppressed = [](const SeriesRow& r) { return r.look && r.look->skin_over_fat > 1; };
  const auto rank = [&](std::size_t n) {
    return std::pair(suppressed(rows[n]) == suppressed(rows[read]),
                     std::abs(rows[n].seconds - rows[read].seconds));
  };
  std::optional<std::size_t> best;
  for (std::size_t n = 0; n < rows.size(); ++n)
    if (n != read && serves(rows[n]) && (!best || rank(n) < rank(*best))) best = n;
  if (best) rows[*best].is_compared = true;
  return best;
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
         {"before_agent", r.is_before_agent},
         {"wall_compared", r.is_compared},
         {"reason", r.reason}});
  return table;
}

}  // namespace mammotwin
