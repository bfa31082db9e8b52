#include "pipeline/report/figures/mri_figure.h"

#include <algorithm>
#include <cmath>

#include "pipeline/report/drawing/breast_window.h"
#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/drawing/panel.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

constexpr double kWidth = 720;  // [pt]
constexpr double kGap = 12;     // [pt] between panels
constexpr Colour kDark{0.16, 0.17, 0.19};

class Slices {
 public:
  Slices(const PatientResults& results, const Landmark& lesion)
      : results_(results), lesion_(lesion), box_(breast_box(results)) {
    if (results.mri) window_ = grey_window(*results.mri, box_);
    if (results.prone) faces_ = all_faces(*results.prone);
  }

  /// Axial (from below), sagittal (from the left or right), coronal (facing the patient).
  std::array<Section, 3> sections() const {
    const Eigen::Vector3d& x = lesion_.prone_in_lps;
    return {Section{2, x.z(), {0}, {1}, box_}, Section{0, x.x(), {1}, {2, true}, box_},
            Section{1, x.y(), {0}, {2, true}, box_}};
  }

  Colour grey(const Eigen::Vector3d& x) const {
    if (!results_.mri) return kDark;
    const double g = window_.of(nearest(*results_.mri, x, 0.0f));
    return {g, g, g};
  }

  /// What the mesh is drawn on: the MRI, or dimmed labels where there is none.
  Colour under_mesh(const Eigen::Vector3d& x) const {
    if (results_.mri) return grey(x);
    return palette::over(palette::with_alpha(labelled(x), 0.45), kDark);
  }

  Colour labelled(const Eigen::Vector3d& x) const {
    const std::uint8_t label = nearest(results_.segmentation->labels, x, label::air);
    const double strength = label::is_lesion(label) ? 0.75 : results_.mri ? 0.40 : 0.95;
    return palette::over(palette::with_alpha(palette::of_label(label), strength), grey(x));
  }

  double pixel_mm() const { return results_.segmentation->labels.spacing.minCoeff() / 2; }

  void draw_mesh(Panel& panel) const {
    if (!results_.prone) return;
    const Section& s = panel.section();
    panel.pieces(cut_by_plane(results_.prone->mesh, faces_, s.normal, s.at), {palette::mesh, 0.9});
  }

  void draw_marks(Panel& panel) const {
    constexpr double kNear_mm = 6;  // the nipple shows on slices that pass this close
    panel.lesion_mark(lesion_.prone_in_lps, 6, lesion_.id, true);
    const auto nipple = results_.nipple();
    const Section& s = panel.section();
    if (nipple && std::abs((*nipple)[s.normal] - s.at) < kNear_mm) panel.nipple_mark(*nipple, true);
  }

 private:
  const PatientResults& results_;
  const Landmark& lesion_;
  Eigen::AlignedBox3d box_;
  GreyWindow window_;
  std::vector<ElementFace> faces_;
};

struct Words {
  const char *name, *left, *right, *top, *bottom;
};
constexpr Words kWords[3] = {{"Axial", "R", "L", "A", "P"},
                             {"Sagittal", "A", "P", "S", "I"},
                             {"Coronal", "R", "L", "S", "I"}};

}  // namespace

Figure mri_figure(const PatientResults& results, const Landmark& lesion) {
  const Slices slices(results, lesion);
  const auto sections = slices.sections();
  double width_mm = 0, height_mm = 0;
  for (const Section& s : sections) {
    width_mm += s.width_mm();
    height_mm = std::max(height_mm, s.height_mm());
  }
  const double scale = (kWidth - 2 * kGap) / width_mm;
  const double row = height_mm * scale + 26;
  Picture picture(kWidth, 2 * row + 4);
  for (int below = 0; below < 2; ++below) {
    double x = 0;
    for (int i = 0; i < 3; ++i) {
      Panel panel(picture, sections[i], x, below * row + 16, scale);
      panel.image(sections[i].sample(slices.pixel_mm(), [&](const Eigen::Vector3d& p) {
        return below ? slices.under_mesh(p) : slices.labelled(p);
      }));
      if (below) slices.draw_mesh(panel);
      slices.draw_marks(panel);
      panel.sides(kWords[i].left, kWords[i].right, kWords[i].top, kWords[i].bottom, true);
      panel.scale_bar(20, palette::paper);
      panel.title(std::string(kWords[i].name) + (!below          ? ", labels"
                                                 : results.prone ? ", mesh"
                                                                 : ", no mesh"));
      x += panel.width() + kGap;
    }
  }
  const Eigen::Vector3d& p = lesion.prone_in_lps;
  const std::string where =
      "L " + word::mm(p.x()) + ", P " + word::mm(p.y()) + ", S " + word::mm(p.z()) + " mm";
  return {picture,
          "Prone " + std::string(results.mri ? "MRI" : "label map") + " through lesion " +
              lesion.id + " (" + where +
              "). Above: labels (skin, fat, fibroglandular, muscle, lesion)." +
              (results.prone ? " Below: the curves in which the fitted mesh cuts the same slices."
                             : ""),
          "Axial, sagittal and coronal slices through lesion " + lesion.id + " at " + where +
              ", once with tissue labels and once with the mesh outline."};
}

}  // namespace mammotwin
