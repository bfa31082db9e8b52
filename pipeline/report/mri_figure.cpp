#include "pipeline/report/mri_figure.h"

#include "pipeline/report/mesh_surface.h"
#include "pipeline/report/palette.h"
#include "pipeline/report/panel.h"
#include "pipeline/report/word.h"
#include "registration/position_grid.h"

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

constexpr double kWidth = 720;      // [pt]
constexpr double kGap = 12;         // [pt] between panels
constexpr double kMargin_mm = 12;   // round the breast

/// Grey values are shown between these fractions of the voxels in the window.
constexpr double kDarkest = 0.01, kBrightest = 0.995;

constexpr Colour kDark{0.16, 0.17, 0.19};

struct Window {
  float low = 0, high = 1;
};

template <class Grid>
Eigen::AlignedBox3d extent(const Grid& grid) {
  const Eigen::Vector3i last = grid.size - Eigen::Vector3i::Ones();
  return {grid.origin, grid.position(last.x(), last.y(), last.z())};
}

Eigen::AlignedBox3d breast_box(const PatientResults& results) {
  const auto& labels = results.segmentation->labels;
  const Eigen::AlignedBox3d image = extent(labels);
  Eigen::AlignedBox3d box;
  if (results.prone) {
    box = bounding_box(results.prone->mesh);
  } else {
    const BreastRegion& region = results.segmentation->region;
    box = Eigen::AlignedBox3d(Eigen::Vector3d(region.x_min, image.min().y(), region.z_min),
                              Eigen::Vector3d(region.x_max, image.max().y(), region.z_max));
  }
  for (const Landmark& lesion : results.lesions()) box.extend(lesion.prone_in_lps);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin_mm);
  return Eigen::AlignedBox3d((box.min() - margin).eval(), (box.max() + margin).eval())
      .intersection(image);
}

template <class T>
T nearest(const Volume<T>& volume, const Eigen::Vector3d& x, T outside) {
  const Eigen::Vector3i v = volume.index(x).array().round().template cast<int>();
  return volume.contains(v.x(), v.y(), v.z()) ? volume(v.x(), v.y(), v.z()) : outside;
}

Window grey_window(const Volume<float>& image, const Eigen::AlignedBox3d& box) {
  std::vector<float> values;
  const Eigen::Vector3i low = image.index(box.min()).array().ceil().cast<int>().max(0);
  const Eigen::Vector3i high =
      image.index(box.max()).cast<int>().cwiseMin(image.size - Eigen::Vector3i::Ones());
  for (int k = low.z(); k <= high.z(); k += 2)
    for (int j = low.y(); j <= high.y(); j += 2)
      for (int i = low.x(); i <= high.x(); i += 2) values.push_back(image(i, j, k));
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double f) { return values[static_cast<std::size_t>(f * (values.size() - 1))]; };
  return {at(kDarkest), std::max(at(kBrightest), at(kDarkest) + 1e-6f)};
}

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
    const double value = (nearest(*results_.mri, x, 0.0f) - window_.low) / (window_.high - window_.low);
    const double g = std::clamp(value, 0.0, 1.0);
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
    panel.pieces(cut_by_plane(results_.prone->mesh, faces_, s.normal, s.at),
                 {palette::mesh, 0.9});
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
  Window window_;
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
      panel.title(std::string(kWords[i].name) + (!below ? ", labels" : results.prone ? ", mesh" : ", no mesh"));
      x += panel.width() + kGap;
    }
  }
  const Eigen::Vector3d& p = lesion.prone_in_lps;
  const std::string where = "L " + word::mm(p.x()) + ", P " + word::mm(p.y()) + ", S " +
                            word::mm(p.z()) + " mm";
  return {picture,
          "Prone " + std::string(results.mri ? "MRI" : "label map") + " through lesion " +
              lesion.id + " (" + where + "). Above: labels (skin, fat, fibroglandular, muscle, lesion)." +
              (results.prone ? " Below: the curves in which the fitted mesh cuts the same slices." : ""),
          "Axial, sagittal and coronal slices through lesion " + lesion.id + " at " + where +
              ", once with tissue labels and once with the mesh outline."};
}

}  // namespace mammotwin
