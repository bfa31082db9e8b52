#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/frame/settings.h"
#include "registration/view/detector.h"
#include "segmentation/segmentation.h"
#include "solver/press/compression_problem.h"

namespace mammotwin {

enum class LawName { neo_hookean, mooney_rivlin, exponential };

/// One tissue's law and its constants; those that the law does not have are not used.
struct LawSettings {
  LawName law = LawName::neo_hookean;
  double c1_kpa = 0;
  double c2_kpa = 0;
  double stiffening = 1;
  double most_stiffening = 1e6;

  /// With every modulus times `factor`.
  std::shared_ptr<const Material> material(double factor) const;
};

/// A traced wall has hollows of a voxel or two: left as it was, two real breasts found no stable
/// balance between the plates.
inline BoundaryOptions on_a_traced_wall() {
  BoundaryOptions boundary;
  boundary.wall_smoothing = 5;
  return boundary;
}

/// What patient.toml says of tissue and of what holds it; made by itself, the tissue that patients
/// are drawn with.
struct CompressionSettings {
  std::string preset = "neo_hookean_2026";  ///< tissue_presets.h
  LawSettings fat{.c1_kpa = 0.75}, fibroglandular{.c1_kpa = 2.5}, lesion{.c1_kpa = 3.3};
  Mixing mixing = Mixing::geometric;
  double stiffness_factor = 1;    ///< on tissue, skin and springs
  bool standing_gravity = false;  ///< the breast sags before the plates close
  double pull = 0;                ///< that holds the breast forward, over its weight
  double most_pull_n = 3;         ///< of it, on what lies in front of the plates' edges
  SkinOptions skin;
  BoundaryOptions boundary = on_a_traced_wall();
  FrictionOptions friction{.coefficient = 0.3};
  double most_force_n = 150;  ///< of the paddle, where nobody says how thick the breast became
  CompressionOptions options;
  double plate_rounding_mm = PlateOptions{}.rounding;
  double wall_clearance_mm = PlateOptions{}.wall_clearance;
  std::optional<double> plate_width_mm, plate_length_mm;
  double paddle_tilt_deg = 0;
  std::optional<double> paddle_spring_nm_per_deg;
  double paddle_pivot_mm = PlateOptions{}.pivot;
  std::optional<std::filesystem::path> support_stl, paddle_stl;

  TissueLaws laws(double factor) const;

  /// Takes what is said of the plates' shape; directions, thickness and facets are the caller's.
  void shape_plates(PlateOptions& plates) const;
};

/// What patient.toml says of one view.
struct ViewSettings {
  std::optional<std::filesystem::path> mammogram;
  std::optional<Eigen::Vector2d> nipple_pixel;   ///< (column, row)
  std::vector<Eigen::Vector2d> pectoral;         ///< none or two points (column, row)
  std::optional<std::filesystem::path> outline;  ///< a mask (PNG) or a contour
  std::optional<double> thickness_mm;
  std::optional<double> angle_deg;
  double default_angle_deg = 0;  ///< where neither header nor patient.toml says one
  std::optional<double> turn_deg;
  double lift_mm = 0;
  std::optional<double> source_distance_mm, support_gap_mm;
  std::optional<double> pixel_spacing_mm;
  std::optional<int> columns, rows;
  std::optional<ImageEdge> chest_wall;
  std::optional<bool> lateral_at_top;
  /// Of a tomosynthesis volume; how many there are is its header's to say.
  std::optional<int> slice_count;
  std::optional<double> slice_spacing_mm, lowest_slice_mm;
  std::optional<bool> first_slice_at_support;

  double angle() const { return angle_deg.value_or(default_angle_deg); }

  static ViewSettings at(double angle_deg) {
    ViewSettings view;
    view.default_angle_deg = angle_deg;
    return view;
  }

  /// Throws std::runtime_error if pixel spacing, columns and rows are given only in part.
  Detector detector(const std::string& view, Side side) const;
};

void declare_compression(Settings& settings, CompressionSettings& compression);
void declare_view(Settings& settings, const std::string& view, ViewSettings& values);

}  // namespace mammotwin
