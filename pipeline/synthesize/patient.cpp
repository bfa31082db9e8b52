#include "pipeline/synthesize/patient.h"

#include <algorithm>
#include <cmath>

#include "pipeline/synthesize/view_extent.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

std::uint8_t label_of(const VoxelMixture& m) {
  struct Candidate {
    int parts;
    std::uint8_t value;
  };
  const Candidate candidates[] = {
      {m[Substance::air], label::air},
      {m.behind(), label::muscle},
      {m[Substance::fat], label::fat},
      {m[Substance::fibroglandular], label::fibroglandular},
      {m[Substance::skin], label::skin},
      {m[Substance::lesion], static_cast<std::uint8_t>(label::lesion + m.lesion)}};
  return std::max_element(std::begin(candidates), std::end(candidates),
                          [](const Candidate& a, const Candidate& b) { return a.parts < b.parts; })
      ->value;
}

template <class Visit>
void for_region(const TissueMap& tissue, const BreastRegion& region, const Visit& visit) {
  const auto& v = tissue.mixtures;
  for (int k = 0; k < v.size.z(); ++k)
    for (int j = 0; j < v.size.y(); ++j)
      for (int i = 0; i < v.size.x(); ++i) {
        const Vector3d x = v.position(i, j, k);
        if (region.contains(x)) visit(x, v(i, j, k));
      }
}

void measure_tissue(const TissueMap& tissue, Truth& truth) {
  double skin = 0, fat = 0, gland = 0, lesion = 0;
  for_region(tissue, truth.region, [&](const Vector3d&, const VoxelMixture& m) {
    skin += m[Substance::skin], fat += m[Substance::fat];
    gland += m[Substance::fibroglandular], lesion += m[Substance::lesion];
  });
  const double ml = tissue.mixtures.voxel_volume() / tissue.parts_per_voxel / 1000;
  truth.skin_ml = skin * ml, truth.fat_ml = fat * ml, truth.fibroglandular_ml = gland * ml;
  truth.breast_ml = (skin + fat + gland + lesion) * ml;
}

std::vector<Lesion> measure_lesions(const TissueMap& tissue, int count) {
  std::vector<double> parts(count, 0);
  std::vector<Vector3d> moments(count, Vector3d::Zero());
  const auto& v = tissue.mixtures;
  for (int k = 0; k < v.size.z(); ++k)
    for (int j = 0; j < v.size.y(); ++j)
      for (int i = 0; i < v.size.x(); ++i) {
        const VoxelMixture& m = v(i, j, k);
        const int p = m[Substance::lesion];
        if (p == 0 || m.lesion >= count) continue;  // the other side's come last
        parts[m.lesion] += p;
        moments[m.lesion] += p * v.position(i, j, k);
      }
  std::vector<Lesion> lesions;
  for (int n = 0; n < count; ++n)
    lesions.push_back({std::string(1, 'L').append(std::to_string(n + 1)), moments[n] / parts[n],
                       parts[n] * v.voxel_volume() / tissue.parts_per_voxel / 1000});
  return lesions;
}

std::vector<Vector3d> centroids(const std::vector<Lesion>& lesions) {
  std::vector<Vector3d> points;
  for (const Lesion& lesion : lesions) points.push_back(lesion.centroid_in_lps);
  return points;
}

Truth measure(const Anatomy& anatomy, const TissueMap& tissue, const Volume<std::uint8_t>& labels,
              const ViewOptions& views) {
  const Side side = anatomy.options().side;
  Truth truth = measure_truth(tissue, labels, side, anatomy.options().lesions);
  truth.nipple_in_lps = anatomy.chest().nipple(side).tip();
  truth.skin_thickness_mm = anatomy.options().skin_mm;
  truth.cc_extent_mm = extent_along_beam(labels, truth.region, 0);
  truth.mlo_extent_mm = extent_along_beam(labels, truth.region, views.mlo_angle_deg);
  return truth;
}

SyntheticPatient image_less(const Anatomy& anatomy, const PatientOptions& o) {
  SyntheticPatient p{o, anatomy.sample(o.scan.voxel_mm, o.scan.samples), {}, {}, {}};
  p.labels = label_map(p.tissue);
  p.truth = measure(anatomy, p.tissue, p.labels, o.views);
  return p;
}

}  // namespace

Volume<std::uint8_t> label_map(const TissueMap& tissue) {
  Volume<std::uint8_t> labels = tissue.mixtures.like<std::uint8_t>();
  std::transform(tissue.mixtures.values.begin(), tissue.mixtures.values.end(),
                 labels.values.begin(), label_of);
  return labels;
}

Segmentation true_segmentation(const TissueMap& tissue, const Volume<std::uint8_t>& labels,
                               const Truth& truth) {
  Segmentation s{labels, labels.like<Fractions>(), truth.region, truth.lesions,
                 truth.nipple_in_lps};
  const double midline = truth.region.side == Side::left ? truth.region.x_min : truth.region.x_max;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const double x = labels.position(i, j, k).x();
        std::uint8_t& value = s.labels(i, j, k);
        if ((truth.region.side == Side::left) != (x >= midline)) value = label::air;
        if (!label::is_breast(value)) continue;
        const VoxelMixture& m = tissue.mixtures(i, j, k);
        const float soft = m[Substance::skin] + m[Substance::fat];
        const float all = soft + m[Substance::fibroglandular] + m[Substance::lesion];
        s.fractions(i, j, k) = {soft / all, m[Substance::fibroglandular] / all,
                                m[Substance::lesion] / all};
      }
  return s;
}

Truth measure_truth(const TissueMap& tissue, const Volume<std::uint8_t>& labels, Side side,
                    int lesions) {
  Truth truth;
  truth.lesions = measure_lesions(tissue, lesions);
  truth.region = true_region(columns_of(labels), side, centroids(truth.lesions));
  measure_tissue(tissue, truth);
  return truth;
}

SyntheticPatient make_patient_without_scan(const PatientOptions& o) {
  check(o);
  return image_less(Anatomy(o.anatomy), o);
}

SyntheticPatient make_patient(const PatientOptions& o) {
  check(o);
  const Anatomy anatomy(o.anatomy);
  SyntheticPatient p = image_less(anatomy, o);
  const Coil coil = coil_round(anatomy.chest(), o.anatomy.side, coil_radius_mm(o.scan.contrast));
  const Vector3d patch = anatomy.chest().breast(o.anatomy.side).axis(0.35) + Vector3d(0, 0, 20);
  p.scan = scan(p.tissue, coil, o.scan, o.anatomy.seed, patch);
  p.truth.shading_ratio = p.scan.shading_ratio;
  return p;
}

}  // namespace mammotwin
