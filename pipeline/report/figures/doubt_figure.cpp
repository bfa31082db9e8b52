#include "pipeline/report/figures/doubt_figure.h"

#include <algorithm>
#include <cmath>

#include "pipeline/report/drawing/breast_window.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/drawing/panel.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

constexpr double kWidth = 420, kGap = 12;  // [pt]
constexpr double kTitle = 16;              // [pt]
constexpr double kLeast_mm = 30;           // to each side of the place
constexpr double kPixel_mm = 0.4;
constexpr Colour kDark{0.16, 0.17, 0.19};

Eigen::AlignedBox3d crop_round(const Volume<std::uint8_t>& labels, const Eigen::Vector3d& place,
                               double radius_mm) {
  const Eigen::Vector3i last = labels.size - Eigen::Vector3i::Ones();
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(std::max(kLeast_mm, 1.5 * radius_mm));
  return Eigen::AlignedBox3d((place - half).eval(), (place + half).eval())
      .intersection(
          Eigen::AlignedBox3d(labels.origin, labels.position(last.x(), last.y(), last.z())));
}

class Crop {
 public:
  Crop(const PatientResults& results, const Eigen::AlignedBox3d& box) : results_(results) {
    if (results.mri) window_ = grey_window(*results.mri, box);
  }

  /// Grey, with the edge between two labels in the colour of the deeper one.
  Colour at(const Eigen::Vector3d& x, const Section& section) const {
    const std::uint8_t here = label_at(x);
    for (const PaperAxis& axis : {section.right, section.down}) {
      Eigen::Vector3d beside = x;
      beside[axis.axis] += kPixel_mm;
      if (const std::uint8_t other = label_at(beside); other != here)
        return palette::of_label(std::max(here, other));
    }
    if (!results_.mri)
      return palette::over(palette::with_alpha(palette::of_label(here), 0.5), kDark);
    const double g = window_.of(nearest(*results_.mri, x, 0.0F));
    return {g, g, g};
  }

 private:
  std::uint8_t label_at(const Eigen::Vector3d& x) const {
    return nearest(results_.segmentation->labels, x, label::air);
  }

  const PatientResults& results_;
  GreyWindow window_;
};

}  // namespace

std::optional<Figure> doubt_figure(const PatientResults& results, const nlohmann::json& doubt) {
  const auto& place = doubt.value("place_lps_mm", nlohmann::json());
  if (!results.segmentation || !place.is_array() || place.size() != 3) return std::nullopt;
  const Eigen::Vector3d x(place[0].get<double>(), place[1].get<double>(), place[2].get<double>());
  const Eigen::AlignedBox3d box =
      crop_round(results.segmentation->labels, x, doubt.value("radius_mm", 0.0));
  if (box.isEmpty() || box.sizes().minCoeff() <= 0) return std::nullopt;
  const Section axial{2, x.z(), {0}, {1}, box}, sagittal{0, x.x(), {1}, {2, true}, box};
  const double scale = (kWidth - kGap) / (axial.width_mm() + sagittal.width_mm());
  Picture picture(kWidth, kTitle + scale * std::max(axial.height_mm(), sagittal.height_mm()) + 4);
  const Crop crop(results, box);
  double left = 0;
  for (const Section& section : {axial, sagittal}) {
    Panel panel(picture, section, left, kTitle, scale);
    panel.image(section.sample(kPixel_mm, [&](const auto& p) { return crop.at(p, section); }));
    panel.scale_bar(10, palette::paper);
    panel.title(section.normal == 2 ? "Axial" : "Sagittal");
    left += panel.width() + kGap;
  }
  const std::string where =
      "L " + word::mm(x.x()) + ", P " + word::mm(x.y()) + ", S " + word::mm(x.z()) + " mm";
  const std::string what = doubt.value("what", "");
  return Figure{picture, what + " at " + where + ": " + doubt.value("reason", "") + ".",
                "Axial and sagittal crops of the MRI round " + where +
                    " with the edges of its labels: " + what + " is doubted there."};
}

}  // namespace mammotwin
