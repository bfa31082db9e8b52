#include "registration/mammogram/mammogram_findings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "registration/mammogram/breast_mask.h"
#include "registration/mammogram/mammogram_masks.h"
#include "registration/mammogram/nipple_marker.h"
#include "registration/mammogram/nipple_search.h"
#include "registration/mammogram/pectoral_edge.h"

namespace mammotwin {
namespace {

constexpr double kBlur_mm = 1;
constexpr double kMarkerSd_mm = 3;  // of a marker stuck on the nipple
constexpr double kSaidSd_mm = 3, kSaidPectoralSd_mm = 3;
/// Skin is smooth (under 0.3 in most of 32 real images, by its curvature); a line that is not
/// follows noise in air or in skin that is hardly seen.
constexpr double kRagged_mm = 0.45;
constexpr double kOutlineSd_mm = 1, kRaggedSd_mm = 6;
constexpr double kUnsureNipple_mm = 5, kUnsurePectoral_mm = 5.6;
/// A muscle's evidence in a view called CC that makes it doubtful; the least in 16 real MLO is 5.
constexpr double kObliqueEvidence = 10;
/// A nipple beyond the skin line, fainter than skin, stands out so far at least.
constexpr double kFaintBulge_mm = 1.5;
/// A marker lies on the skin: so far from the skin line at most.
constexpr double kMarkerReach_mm = 15;

MammogramImage without_borders(MammogramImage image) {
  paint_over_borders(image);
  return image;
}

/// The vertical edge that more of the breast touches.
ImageEdge chest_wall_edge(const MammogramImage& mask) {
  double left = 0, right = 0;
  for (int row = 0; row < mask.rows; ++row)
    for (int i = 0; i < mask.columns / 20; ++i) {
      left += mask.at(i, row);
      right += mask.at(mask.columns - 1 - i, row);
    }
  return left >= right ? ImageEdge::left : ImageEdge::right;
}

MammogramImage hung(MammogramImage mask, ImageEdge chest_wall) {
  if (chest_wall == ImageEdge::left) return mask;
  for (int row = 0; row < mask.rows; ++row) {
    const auto begin = mask.grey.begin() + static_cast<std::ptrdiff_t>(row) * mask.columns;
    std::reverse(begin, begin + mask.columns);
  }
  return mask;
}

/// What lies between the chest wall and a line, by rows.
MammogramImage mask_within(const std::vector<Eigen::Vector2d>& line, const UprightImage& image) {
  MammogramImage mask = image.image();
  std::vector<double> depth(mask.rows, 0);
  for (std::size_t n = 1; n < line.size(); ++n) {
    const Eigen::Vector2d &a = line[n - 1], &b = line[n];
    const double steps = std::ceil((b - a).norm() / (image.pixel_mm() / 2)) + 1;
    for (double k = 0; k <= steps; ++k) {
      const Eigen::Vector2d x = a + (b - a) * (k / steps);
      const int row = static_cast<int>(std::floor(x.y() / image.pixel_mm()));
      if (row >= 0 && row < mask.rows) depth[row] = std::max(depth[row], x.x());
    }
  }
  for (int row = 0; row < mask.rows; ++row)
    for (int column = 0; column < mask.columns; ++column)
      mask.at(column, row) = (column + 0.5) * image.pixel_mm() < depth[row];
  return mask;
}

double distance(const Eigen::Vector2d& x, const std::vector<Eigen::Vector2d>& line) {
  double squared = 1e30;
  for (const Eigen::Vector2d& y : line) squared = std::min(squared, (x - y).squaredNorm());
  return std::sqrt(squared);
}

/// One mammogram on its way from pixels to findings.
class Reading {
 public:
  Reading(const MammogramImage& image, double pixel_mm, bool oblique, const SaidFindings& said)
      : image_(image),
        pixel_mm_(pixel_mm),
        oblique_(oblique),
        said_(said),
        upright_(without_borders(image), pixel_mm) {}

  MammogramFindings run() {
    read_outline();
    smooth_ = upright_;
    smooth_->image() = smoothed(upright_.image(), kBlur_mm / upright_.pixel_mm());
    read_pectoral();
    read_nipple();
    return found_;
  }

 private:
  void read_outline() {
    if (!said_.outline.empty()) return take_outline();
    const MammogramImage mask =
        said_.mask ? said_mask() : breast_mask(upright_.image(), upright_.pixel_mm());
    found_.chest_wall = chest_wall_edge(mask);
    upright_.hang(found_.chest_wall);
    mask_ = hung(mask, found_.chest_wall);
    skin_ = skin_line(mask_, upright_.pixel_mm(), oblique_);
    keep_exposed(skin_.points);
    for (const Eigen::Vector2d& x : skin_.points)
      found_.outline.push_back(upright_.stored_pixel(x));
    found_.remarks = skin_.remarks;
    const bool ragged = skin_.roughness_mm > kRagged_mm;
    found_.outline_sd_mm = ragged ? kRaggedSd_mm : kOutlineSd_mm;
    if (ragged && !said_.mask)
      doubt("outline", "the outline is ragged; views.*.outline can say it");
  }

  /// Beyond the exposed field an image repeats its border: an end of the skin there is none.
  void keep_exposed(std::vector<Eigen::Vector2d>& line) const {
    if (!image_.field) return;
    const auto hidden = [&](const Eigen::Vector2d& x) {
      const Eigen::Vector2d pixel = upright_.stored_pixel(x);
      const ExposedField& f = *image_.field;
      return pixel.x() < f.first_column || pixel.x() > f.last_column || pixel.y() < f.first_row ||
             pixel.y() > f.last_row;
    };
    while (!line.empty() && hidden(line.back())) line.pop_back();
    line.erase(line.begin(), std::find_if_not(line.begin(), line.end(), hidden));
    if (line.size() < 2) throw std::runtime_error("no skin line is seen: the collimator covers it");
  }

  MammogramImage said_mask() const {
    if (said_.mask->columns != image_.columns || said_.mask->rows != image_.rows)
      throw std::runtime_error(
          "outline: the mask has " + std::to_string(said_.mask->columns) + " x " +
          std::to_string(said_.mask->rows) + " pixels; expected the mammogram's " +
          std::to_string(image_.columns) + " x " + std::to_string(image_.rows));
    MammogramImage mask = *said_.mask;
    for (float& m : mask.grey) m = m > 0;
    mask = UprightImage(mask, pixel_mm_).image();
    for (float& m : mask.grey) m = m > 0.5f;
    return mask;
  }

  void take_outline() {
    const auto& line = said_.outline;
    if (line.size() < 2) throw std::runtime_error("outline: expected two points or more");
    const double middle = (image_.columns - 1) / 2.;
    double ends = 0;
    for (const Eigen::Vector2d& end : {line.front(), line.back()}) ends += end.x() / 2;
    found_.chest_wall = ends < middle ? ImageEdge::left : ImageEdge::right;
    upright_.hang(found_.chest_wall);
    for (const Eigen::Vector2d& pixel : line) skin_.points.push_back(upright_.place(pixel));
    if (skin_.points.front().y() > skin_.points.back().y())
      std::reverse(skin_.points.begin(), skin_.points.end());
    for (const Eigen::Vector2d& x : skin_.points)
      found_.outline.push_back(upright_.stored_pixel(x));
    mask_ = mask_within(skin_.points, upright_);
    found_.outline_sd_mm = kOutlineSd_mm;
  }

  void read_pectoral() {
    if (said_.pectoral) {
      found_.pectoral = said_.pectoral;
      found_.pectoral_curve = {said_.pectoral->first, said_.pectoral->second};
      found_.pectoral_sd_mm = kSaidPectoralSd_mm;
      return;
    }
    const std::optional<PectoralEdge> edge = pectoral_edge(*smooth_, mask_);
    if (!oblique_) {
      if (edge && edge->evidence > kObliqueEvidence)
        doubt_view("a pectoral edge crosses this CC as it does an MLO; is it one?");
      return;
    }
    if (!edge) {
      found_.unsure.push_back("pectoral");
      return doubt_view(
          "no pectoral edge is seen in this MLO; is it one, and does it hang upright? "
          "views.mlo.pectoral can say the edge");
    }
    found_.pectoral = {upright_.stored_pixel(edge->top), upright_.stored_pixel(edge->end)};
    for (const Eigen::Vector2d& x : edge->points)
      found_.pectoral_curve.push_back(upright_.stored_pixel(x));
    found_.pectoral_sd_mm = edge->sd_mm;
    if (edge->sd_mm > kUnsurePectoral_mm)
      doubt("pectoral", "the pectoral edge is not clear; views.mlo.pectoral can say it");
  }

  void read_nipple() {
    if (said_.nipple) return take_nipple(*said_.nipple, NippleEvidence::said, kSaidSd_mm);
    const auto marker = find_marker(image_, pixel_mm_);
    if (marker && distance(upright_.place(*marker), skin_.points) < kMarkerReach_mm)
      return take_nipple(*marker, NippleEvidence::marker, kMarkerSd_mm);
    NippleFinding nipple = find_nipple(nipple_profile(skin_, *smooth_), oblique_);
    if (!nipple.in_profile && said_.outline.empty())
      if (const auto faint = faint_nipple()) nipple = *faint;
    take_nipple(upright_.stored_pixel(nipple.candidates.front().place),
                nipple.in_profile ? NippleEvidence::profile : NippleEvidence::not_in_profile,
                nipple.sd_mm);
    found_.nipples.clear();
    for (const NippleCandidate& c : nipple.candidates)
      found_.nipples.push_back({upright_.stored_pixel(c.place), c.probability});
    if (nipple.sd_mm > kUnsureNipple_mm)
      doubt("nipple", std::string("the nipple is not clear") +
                          (nipple.in_profile ? "" : ", not in profile") +
                          "; views.*.nipple_pixel can say it");
  }

  /// A nipple in profile that is fainter than any skin, as film readers leave it.
  std::optional<NippleFinding> faint_nipple() const {
    try {
      SkinLine line = skin_line(breast_mask(upright_.image(), upright_.pixel_mm(), kFaintShare),
                                upright_.pixel_mm(), oblique_);
      keep_exposed(line.points);
      const NippleFinding nipple = find_nipple(nipple_profile(line, *smooth_), oblique_);
      if (nipple.candidates.front().bulge_mm > kFaintBulge_mm && nipple.sd_mm < kUnsureNipple_mm)
        return nipple;
    } catch (const std::runtime_error&) {  // at that brightness no breast is seen: nor a nipple
    }
    return std::nullopt;
  }

  void take_nipple(const Eigen::Vector2d& pixel, NippleEvidence evidence, double sd_mm) {
    found_.nipple = pixel;
    found_.evidence = evidence;
    found_.nipple_sd_mm = sd_mm;
    found_.nipples = {{pixel, 1}};
  }

  void doubt_view(const std::string& words) {
    doubt("view", words);
    found_.view_doubt = words;
  }

  void doubt(const char* what, const std::string& words) {
    found_.unsure.push_back(what);
    found_.remarks.push_back(words);
  }

  const MammogramImage& image_;
  double pixel_mm_;
  bool oblique_;
  const SaidFindings& said_;
  UprightImage upright_;
  std::optional<UprightImage> smooth_;
  MammogramImage mask_;
  SkinLine skin_;
  MammogramFindings found_;
};

}  // namespace

const char* name_of(NippleEvidence evidence) {
  switch (evidence) {
    case NippleEvidence::marker:
      return "marker";
    case NippleEvidence::profile:
      return "profile";
    case NippleEvidence::said:
      return "said";
    case NippleEvidence::not_in_profile:
      break;
  }
  return "not in profile";
}

MammogramFindings find_breast(const MammogramImage& image, double pixel_mm, bool oblique,
                              const SaidFindings& said) {
  return Reading(image, pixel_mm, oblique, said).run();
}

}  // namespace mammotwin
