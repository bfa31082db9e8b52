#include "tests/pipeline/report/report_fake_results.h"

#include <cmath>
#include <functional>

#include "fitting/mesh/block_mesh.h"

namespace mammotwin {
namespace {

using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

constexpr double kRadius = 62, kHeight = 75, kThickness = 50;  // [mm]

/// Nodal parameters of a smooth map of grid coordinates, derivatives by central differences.
std::vector<HermiteMesh::Node> sampled(const HermiteMesh& grid, const Map& map) {
  constexpr double h = 1e-3;
  std::vector<HermiteMesh::Node> nodes;
  for (const HermiteMesh::Node& at : grid.nodes()) {
    HermiteMesh::Node node;
    for (int d = 0; d < 8; ++d) {
      node.col(d).setZero();
      for (int corner = 0; corner < 8; ++corner) {
        if ((corner & ~d) != 0) continue;
        Eigen::Vector3d shift = Eigen::Vector3d::Zero();
        double sign = 1;
        for (int a = 0; a < 3; ++a)
          if (d >> a & 1) {
            const double s = corner >> a & 1 ? 1 : -1;
            shift[a] = s * h;
            sign *= s / (2 * h);
          }
        node.col(d) += sign * map(at.col(0) + shift);
      }
    }
    nodes.push_back(node);
  }
  return nodes;
}

double centre_x(Side side) { return side == Side::left ? 75 : -75; }

double dome(double x, double z) {
  return 12 + kHeight * std::exp(-1.6 * (x * x + z * z) / (kRadius * kRadius));
}

MeshFile prone_mesh(Side side) {
  const HermiteMesh grid = block_mesh({0, 0, 0}, {6, 6, 2}, {6, 6, 2});
  const Map map = [&](const Eigen::Vector3d& g) {
    const double x = (g.x() - 3) / 3 * 60, z = (g.y() - 3) / 3 * 60;
    return Eigen::Vector3d(centre_x(side) + x, -dome(x, z) * g.z() / 2, z);
  };
  MeshFile file{HermiteMesh(sampled(grid, map), grid.elements()), {}, {}, {}, {}, {}};
  for (int e = 0; e < file.mesh.num_elements(); ++e) {
    const int i = e % 6, j = e / 6 % 6, k = e / 36;
    const auto cut = [](bool outer) { return outer ? FaceLabel::cut : FaceLabel::interior; };
    file.faces.push_back({cut(i == 0), cut(i == 5), cut(j == 0), cut(j == 5),
                          k == 0 ? FaceLabel::chest_wall : FaceLabel::interior,
                          k == 1 ? FaceLabel::skin : FaceLabel::interior});
  }
  return file;
}

/// Squeezed between two plates that meet the tissue 10 mm in front of the chest wall.
ViewResult squeezed(const MeshFile& prone, Side side, const std::string& name, double angle_deg) {
  const Eigen::Matrix3d axes = view_axes(side, angle_deg);
  const double ratio = kThickness / 120, stretch = 1 / std::sqrt(ratio);
  const Eigen::Matrix3d A =
      axes.transpose() * Eigen::Vector3d(stretch, stretch, ratio).asDiagonal() * axes;
  const Eigen::Vector3d middle(centre_x(side), 0, 0);
  std::vector<HermiteMesh::Node> nodes = prone.mesh.nodes();
  for (HermiteMesh::Node& node : nodes) {
    node.col(0) -= middle;
    node = (A * node).eval();
    node.col(0) += middle;
  }
  CompressedView view{name, side, angle_deg, kThickness, {}};
  view.frame.axes = axes;
  view.frame.origin_in_lps = middle + axes.transpose() * Eigen::Vector3d(10, 0, -kThickness / 2);
  MeshFile file{HermiteMesh(std::move(nodes), prone.mesh.elements()), prone.faces, {}, {}, {}, {}};
  return {std::move(file), std::move(view), Detector{}};
}

std::uint8_t tissue(const Eigen::Vector3d& x, Side side) {
  const Eigen::Vector3d c(centre_x(side), 0, 0), p = x - c;
  if (x.y() > 0) return x.y() < 25 ? label::muscle : label::air;
  const double depth = dome(p.x(), p.z()) + x.y();
  if (depth < 0) return label::air;
  if (depth < 2) return label::skin;
  const double bumpy = 22 + 5 * std::sin(p.x() / 4) * std::cos(p.z() / 5);
  return (p - Eigen::Vector3d(0, -32, 0)).norm() < bumpy ? label::fibroglandular : label::fat;
}

Segmentation segmentation(Side side) {
  Segmentation s;
  const double x0 = centre_x(side) - 70;
  s.labels = Volume<std::uint8_t>({71, 64, 71}, {2, 2, 2}, {x0, -100, -70});
  s.fractions = s.labels.like<Fractions>();
  s.region = {side, centre_x(side) - 60, centre_x(side) + 60, -60, 60};
  s.nipple_in_lps = {centre_x(side), -kHeight - 12, 0};
  const double out = side == Side::left ? 1 : -1;
  s.lesions = {{"1", {centre_x(side) + 18 * out, -30, 14}, 0.9},
               {"2", {centre_x(side) - 10 * out, -52, -12}, 0.4}};
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        std::uint8_t& label = s.labels(i, j, k);
        label = tissue(x, side);
        for (std::size_t n = 0; n < s.lesions.size(); ++n)
          if ((x - s.lesions[n].centroid_in_lps).norm() < 6) label = label::lesion + n;
        if (label == label::air || label == label::muscle) continue;
        Fractions& f = s.fractions(i, j, k);
        (label::is_lesion(label)          ? f.lesion
         : label == label::fibroglandular ? f.fibroglandular
                                          : f.fat) = 1;
      }
  return s;
}

Volume<float> mri_of(const Segmentation& s) {
  Volume<float> mri = s.labels.like<float>();
  for (std::size_t i = 0; i < mri.values.size(); ++i) {
    const std::uint8_t label = s.labels.values[i];
    mri.values[i] = label == label::air              ? 5.0f
                    : label == label::fat            ? 60.0f
                    : label == label::fibroglandular ? 120.0f
                    : label::is_lesion(label)        ? 220.0f
                                                     : 90.0f;
  }
  return mri;
}

nlohmann::json sidecar(const std::string& stage, const nlohmann::json& quality) {
  return {{"status", "ok"},
          {"reasons", nlohmann::json::array()},
          {"stage", stage},
          {"version", "0.1.0"},
          {"command", "mammotwin-" + stage},
          {"parameters", {{stage + ".example", {{"value", 1.5}, {"unit", "mm"}}}}},
          {"inputs", {{{"path", "input"}, {"sha256", std::string(64, 'a')}}}},
          {"quality", quality},
          {"seconds", 1.25},
          {"peak_memory_mb", 210.0}};
}

nlohmann::json squeeze_quality(double angle_deg) {
  nlohmann::json history = nlohmann::json::array();
  for (int step = 1; step <= 6; ++step)
    history.push_back({{"thickness_mm", 120 - 70.0 * step / 6},
                       {"force_N", 2.4 * step * step},
                       {"iterations", 10 + step}});
  return {{"angle_deg", angle_deg},  {"thickness_mm", kThickness}, {"force_N", 86.4},
          {"volume_change", 0.0003}, {"newton_iterations", 101},   {"history", history}};
}

}  // namespace

PatientResults fake_results(Side side) {
  PatientResults r;
  r.patient = "made-up";
  r.segmentation = segmentation(side);
  r.mri = mri_of(*r.segmentation);
  r.prone = prone_mesh(side);
  r.prone->fields["skin_distance_mm"] = interpolate_field(
      r.prone->mesh, [&](const MeshPoint& p) { return 0.01 * r.prone->mesh.position(p).z(); });
  r.unloaded = r.prone->mesh;
  r.files = {"cc.vtu", "cc.vtu.json", "lesions.csv"};
  r.views.push_back(squeezed(*r.prone, side, "cc", 0));
  r.views.push_back(squeezed(*r.prone, side, "mlo", 45));
  const Landmark nipple{"nipple", r.segmentation->nipple_in_lps};
  for (const Landmark& lesion : r.lesions()) {
    r.rows.push_back(mri_row(r.patient, side, lesion, nipple.prone_in_lps));
    for (const ViewResult& v : r.views) {
      const ViewProjection p(r.prone->mesh, v.file.mesh, v.view, v.detector);
      r.rows.push_back(view_row(r.patient, v.view, p.project(lesion), p.project(nipple)));
    }
  }
  add_extent(*r.segmentation, r.rows);
  r.stages = {{"segmentation.seg.nrrd",
               sidecar("segment", {{"side", "left"}, {"breast_volume_ml", 512.3}})},
              {"prone.vtu", sidecar("fit", {{"skin_rms_mesh_to_data_mm", 0.22},
                                            {"skin_rms_data_to_mesh_mm", 0.25},
                                            {"skin_p95_mm", 0.51},
                                            {"skin_max_mm", 1.9},
                                            {"chest_wall_rms_mm", 0.4}})},
              {"unloaded.vtu", sidecar("unload", {{"gravity", "prone"},
                                                  {"gravity_factor", 1.0},
                                                  {"sag_max_mm", 7.15},
                                                  {"stretch_p95", 1.093},
                                                  {"stiffness_factor", 1.0}})},
              {"cc.vtu", sidecar("compress", squeeze_quality(0))},
              {"mlo.vtu", sidecar("compress", squeeze_quality(45))},
              {"lesions.csv", sidecar("register", nlohmann::json::object())}};
  return r;
}

}  // namespace mammotwin
