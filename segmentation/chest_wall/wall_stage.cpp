#include "segmentation/chest_wall/wall_stage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "segmentation/body/midline.h"
#include "segmentation/chest_wall/drawn_wall.h"
#include "segmentation/chest_wall/muscle_brightness.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/em_bias.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

constexpr int num_classes = 4;  // lung and noise, fat, muscle and gland, vessels and skin

/// Muscle over fat: the class nearest to what the study saw (1.4 to 2.0, 0.4), if in range.
double muscle_over_fat(const BiasEstimate& bias, double log_fat, bool fat_suppressed) {
  const double usual = fat_suppressed ? 1.55 : 0.40;
  const double low = fat_suppressed ? 1.25 : 0.25, high = fat_suppressed ? 2.0 : 0.65;
  double best = usual, nearest = 1e9;
  for (const IntensityClass& c : bias.classes) {
    const double ratio = std::exp(c.mean - log_fat);
    if (ratio < low || ratio > high || std::abs(std::log(ratio / usual)) > nearest) continue;
    nearest = std::abs(std::log(ratio / usual));
    best = ratio;
  }
  return best;
}

/// The body with its thorax closed: where a flank is too dim to be seen, the lung passes for air,
/// and rays would end in it. From 20 mm behind the skin between the breasts on, a row is body
/// between the outermost body voxels of itself and the rows in front of it.
Volume<std::uint8_t> with_closed_thorax(const BodyStage& stage) {
  constexpr double behind_mm = 20;
  Volume<std::uint8_t> body = stage.body;
  const int first = static_cast<int>(
      std::ceil((stage.frame.sternal_y + behind_mm - body.origin.y()) / body.spacing.y()));
  for (int k = 0; k < body.size.z(); ++k) {
    int low = body.size.x(), high = -1;
    for (int j = std::max(0, first); j < body.size.y(); ++j) {
      for (int i = 0; i < body.size.x(); ++i)
        if (body(i, j, k)) low = std::min(low, i), high = std::max(high, i);
      for (int i = low; i <= high; ++i) body(i, j, k) = 1;
    }
  }
  return body;
}

Volume<float> corrected(Volume<float> image, const BiasEstimate& bias) {
  tbb::parallel_for(0, image.size.z(), [&](int k) {
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        image(i, j, k) *= bias.correction(image.position(i, j, k));
  });
  return image;
}

/// What the study saw, and what this image's own samples say where that is another: on other
/// scanners muscle is darker than suppressed fat, or far brighter.
std::vector<double> possible_muscles(const WallStage& stage, const Volume<std::uint8_t>& body,
                                     const BreastFrame& frame) {
  constexpr double other = 1.25;      // times: within that the wall is the same
  constexpr double told_apart = 1.1;  // times fat: nearer, nothing is seen of the wall
  const PectoralWall grid = wall_grid(stage.corrected, frame);
  const double learnt = learnt_muscle(cast_rays(stage.corrected, body, grid), grid,
                                      usual_radii(grid, frame), frame.z_low, frame.z_high);
  std::vector<double> muscles{stage.contrast.muscle};
  if (learnt > 0 && std::abs(std::log(learnt / muscles[0])) > std::log(other) &&
      std::abs(std::log(learnt)) > std::log(told_apart))
    muscles.push_back(learnt);
  return muscles;
}

/// The wall found with the first brightness of muscle; where the image supports that badly, of all
/// the one that it supports best. Compared always, a learnt brightness drew parts of a wall that
/// was right to edges 20 mm behind it (a late phase).
template <class Find>
SettledWall best_supported(const std::vector<double>& muscles, const BreastFrame& frame,
                           const Find& find) {
  constexpr double badly = 0.25;    // of the rays; 0.13 at most on real walls that are right
  constexpr double clearly = 0.02;  // of the rays
  const auto unsupported = [&](const PectoralWall& wall) {
    double sum = 0;
    for (const Side side : {Side::left, Side::right})
      sum += wall.doubt(side, frame.z_low, frame.z_high) +
             wall.fat_behind(side, frame.z_low, frame.z_high);
    return sum / 2;
  };
  SettledWall best = find(muscles.front());
  if (unsupported(best.wall) < badly) return best;
  for (std::size_t n = 1; n < muscles.size(); ++n)
    if (SettledWall other = find(muscles[n]);
        unsupported(other.wall) + clearly < unsupported(best.wall))
      best = std::move(other);
  return best;
}

/// What is known only roughly before a search, and how far off it may be.
struct Beforehand {
  double usual_off_mm = 0, muscle_times = 1;
};

std::vector<UsualRadius> moved(std::vector<UsualRadius> usual, double by_mm) {
  for (UsualRadius& ray : usual) ray.mean += by_mm;
  return usual;
}

/// The wall of one image.
class WallSearch {
 public:
  WallSearch(const BodyStage& body, const WallStage& stage, double stiffness,
             const std::vector<Eigen::Vector3d>& drawn_in_lps)
      : frame_(body.frame),
        closed_(with_closed_thorax(body)),
        contrast_(stage.contrast),
        muscles_(possible_muscles(stage, closed_, frame_)),
        stiffness_(stiffness),
        usual_(usual_radii(wall_grid(stage.corrected, frame_), frame_)),
        drawn_(drawn_radii(wall_grid(stage.corrected, frame_), drawn_in_lps)) {}

  SettledWall find(const Volume<float>& smooth, const Beforehand& told) const {
    const std::vector<UsualRadius> usual = moved(usual_, told.usual_off_mm);
    return best_supported(muscles_, frame_, [&](double muscle) {
      WallContrast contrast = contrast_;
      contrast.muscle = muscle * told.muscle_times;
      const auto by = [&](const std::vector<UsualRadius>& where) {
        return find_pectoral_wall(smooth, closed_, frame_, contrast, stiffness_, where, drawn_);
      };
      return settled_wall(by({}), by(usual), frame_.z_low, frame_.z_high);
    });
  }

 private:
  BreastFrame frame_;
  Volume<std::uint8_t> closed_;
  WallContrast contrast_;
  std::vector<double> muscles_;
  double stiffness_;
  std::vector<UsualRadius> usual_, drawn_;
};

Volume<float> smoothed_for_rays(Volume<float> image) {
  constexpr double ray_smoothing_mm = 0.8;  // about a voxel: noise falls, the edge stays
  return gaussian_smoothed(std::move(image), ray_smoothing_mm);
}

/// The middle of three searches.
FoundWall find_steady(const WallSearch& search, const Volume<float>& smooth) {
  constexpr double usual_off_mm = 3;     // ten women's mean, of a spread of 6 to 10 mm
  constexpr double muscle_times = 1.07;  // a class's mean, of a spread of 0.2
  FoundWall found;
  found.first = search.find(smooth, {});
  found.searches = {found.first.wall, search.find(smooth, {usual_off_mm, muscle_times}).wall,
                    search.find(smooth, {-usual_off_mm, 1 / muscle_times}).wall};
  found.wall = middle_wall(found.searches);
  return found;
}

/// Compares the images before and after contrast agent in front of the wall, on one side.
PreMatch match_breast(const BodyStage& body, const Volume<float>& pre, const PectoralWall& wall,
                      Side side) {
  auto breast = body.body;
  tbb::parallel_for(0, breast.size.z(), [&](int k) {
    for (int j = 0; j < breast.size.y(); ++j)
      for (int i = 0; i < breast.size.x(); ++i) {
        if (!breast(i, j, k)) continue;
        const Eigen::Vector3d x = breast.position(i, j, k);
        breast(i, j, k) = is_on_side(x.x(), body.frame.midline_x, side) && !wall.is_behind(x);
      }
  });
  constexpr int margin = 8;  // voxels: more than smoothing reaches
  const auto [low, high] = box_around(breast, margin);
  const Volume<float> after = cropped(body.image, low, high);
  return match_pre(after, cropped(pre, low, high),
                   after.like<float>(static_cast<float>(body.noise)), cropped(breast, low, high));
}

}  // namespace

WallStage find_wall(const BodyStage& body, const BeforeAgent& before, Side side, double stiffness,
                    const std::vector<Eigen::Vector3d>& drawn_in_lps) {
  const BiasEstimate bias = estimate_bias(body.image, body.body, num_classes);
  WallStage stage;
  stage.wide_log_bias = bias.wide_log_bias;
  stage.corrected = corrected(body.image, bias);
  const auto fat_of = [&](const Volume<float>& image) {
    return subcutaneous_fat(image, body.depth, body.frame, body.contrast.fat_suppressed);
  };
  const double fat = fat_of(stage.corrected);
  for (float& value : stage.corrected.values) value /= static_cast<float>(fat);
  stage.contrast.muscle = muscle_over_fat(bias, std::log(fat), body.contrast.fat_suppressed);
  const WallSearch search(body, stage, stiffness, drawn_in_lps);
  if (!before.is_given()) {
    stage.found = find_steady(search, smoothed_for_rays(stage.corrected));
    return stage;
  }
  const PectoralWall alone = search.find(smoothed_for_rays(stage.corrected), {}).wall;
  stage.pre_match = match_breast(body, before.image, alone, side);
  if (stage.pre_match->moved()) {
    stage.found = find_steady(search, smoothed_for_rays(stage.corrected));
    return stage;
  }
  const Volume<float> pre = corrected(before.image, bias);
  stage.found =
      find_steady(search, smoothed_for_rays(mean_with_pre(stage.corrected, pre, 1 / fat_of(pre))));
  return stage;
}

}  // namespace mammotwin
