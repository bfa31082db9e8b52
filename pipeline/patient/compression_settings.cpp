#include "pipeline/patient/compression_settings.h"

#include <stdexcept>

#include "pipeline/patient/tissue_presets.h"
#include "solver/material/exponential.h"
#include "solver/material/mooney_rivlin.h"
#include "solver/material/neo_hookean.h"

namespace mammotwin {
namespace {

const Range kModulus{0.01, 1000, "kPa", "c1 is half the shear modulus, about a sixth of E"};

void declare_law(Settings& s, const std::string& tissue, LawSettings& law) {
  const std::string prefix = "materials." + tissue + ".";
  s.choice(prefix + "law", law.law,
           {{"neo_hookean", LawName::neo_hookean},
            {"mooney_rivlin", LawName::mooney_rivlin},
            {"exponential", LawName::exponential}},
           "stored energy of " + tissue);
  s.number(prefix + "c1_kpa", law.c1_kpa, kModulus, "c1 of " + tissue);
  s.number(prefix + "c2_kpa", law.c2_kpa, {0, 1000, "kPa"}, "c2, mooney_rivlin only");
  s.number(prefix + "stiffening", law.stiffening, {0.001, 20}, "b, exponential only");
  s.number(prefix + "most_stiffening", law.most_stiffening, {1, 1e6},
           "so many times as stiff as at rest at most, exponential only");
}

}  // namespace

std::shared_ptr<const Material> LawSettings::material(double factor) const {
  switch (law) {
    case LawName::neo_hookean:
      return std::make_shared<NeoHookean>(factor * c1_kpa);
    case LawName::mooney_rivlin:
      return std::make_shared<MooneyRivlin>(factor * c1_kpa, factor * c2_kpa);
    case LawName::exponential:
      return std::make_shared<Exponential>(factor * c1_kpa, stiffening, most_stiffening);
  }
  throw std::logic_error("unknown law");
}

TissueLaws CompressionSettings::laws(double factor) const {
  return {{fat.material(factor), fibroglandular.material(factor), lesion.material(factor)}, mixing};
}

void CompressionSettings::shape_plates(PlateOptions& plates) const {
  constexpr double mN_mm_per_N_m = 1e6;
  plates.rounding = plate_rounding_mm;
  plates.wall_clearance = wall_clearance_mm;
  if (plate_width_mm) plates.width = *plate_width_mm;
  if (plate_length_mm) plates.length = *plate_length_mm;
  plates.paddle_tilt = paddle_tilt_deg;
  if (paddle_spring_nm_per_deg) plates.tilt_spring = *paddle_spring_nm_per_deg * mN_mm_per_N_m;
  plates.pivot = paddle_pivot_mm;
}

Detector ViewSettings::detector(const std::string& view, Side side) const {
  Detector detector;
  detector.source_distance_mm = source_distance_mm.value_or(detector.source_distance_mm);
  detector.support_gap_mm = support_gap_mm.value_or(detector.support_gap_mm);
  const int given = pixel_spacing_mm.has_value() + columns.has_value() + rows.has_value();
  if (given != 0 && given != 3)
    throw std::runtime_error("views." + view +
                             ".detector: pixel_spacing_mm, columns and rows are "
                             "given only in part; expected all three, or none for mm alone");
  if (given == 3) {
    const ImageEdge as_hung = side == Side::left ? ImageEdge::left : ImageEdge::right;
    detector.pixels = PixelGrid{*pixel_spacing_mm, *columns, *rows, chest_wall.value_or(as_hung),
                                lateral_at_top.value_or(true)};
  }
  if (slice_count)
    detector.slices = TomosynthesisSlices{*slice_count, slice_spacing_mm.value(),
                                          lowest_slice_mm.value(), first_slice_at_support.value()};
  check_detector(detector);
  return detector;
}

void declare_compression(Settings& s, CompressionSettings& c) {
  declare_law(s, "fat", c.fat);
  declare_law(s, "fibroglandular", c.fibroglandular);
  declare_law(s, "lesion", c.lesion);
  s.choice("materials.mixing", c.mixing,
           {{"arithmetic", Mixing::arithmetic},
            {"geometric", Mixing::geometric},
            {"harmonic", Mixing::harmonic}},
           "stiffness of a quadrature point that holds several tissues");
  s.number("materials.stiffness_factor", c.stiffness_factor, {0.01, 100},
           "on all stiffnesses: tissue, skin and springs");
  s.flag("materials.skin.membrane", c.skin.on, "skin resists stretch as a membrane");
  s.number("materials.skin.c1_kpa", c.skin.c1, kModulus,
           "c1 of the skin; fat in its place has part of it, a membrane the rest");
  s.number("materials.skin.thickness_mm", c.skin.thickness, {0.1, 5, "mm"},
           "thickness of the skin");
  s.number("materials.skin.stiffening", c.skin.stiffening, {0, 20},
           "b of the skin: slack at first, stiff when stretched; 0: neo-Hookean");
  s.choice(
      "compress.chest_wall", c.boundary.chest_wall,
      {{"sliding", ChestWall::sliding}, {"free", ChestWall::free}, {"clamped", ChestWall::clamped}},
      "breast on the pectoral muscle: held on its surface against springs, freely, or fixed");
  s.number("compress.chest_wall_spring_kpa_per_mm", c.boundary.chest_wall_spring, {0, 10, "kPa/mm"},
           "springs against sliding");
  s.number("compress.chest_wall_reach_mm", c.boundary.chest_wall_reach, {1, 1000, "mm"},
           "about so far they give way before they stiffen; default linear springs");
  s.number(
      "compress.chest_wall_smoothing_mm", c.boundary.wall_smoothing, {0, 100, "mm"},
      "hollows of the wall up to about 6 times as wide do not catch what slides on it; 0: all");
  s.choice(
      "compress.cut_faces", c.boundary.cut_faces,
      {{"springs", CutFaces::springs}, {"free", CutFaces::free}, {"clamped", CutFaces::clamped}},
      "where tissue goes on behind the model");
  s.number("compress.cut_face_depth_mm", c.boundary.cut_face_depth, {1, 1000, "mm"},
           "depth of the tissue behind a cut face: spring = shear modulus / depth");
  s.number("compress.cut_face_reach_mm", c.boundary.cut_face_reach, {1, 1000, "mm"},
           "about so far these springs give way before they stiffen; default linear");
  s.number("compress.plate_rounding_mm", c.plate_rounding_mm, {0.5, 50, "mm"},
           "radius of the plates' edges at the chest wall");
  s.number("compress.wall_clearance_mm", c.wall_clearance_mm, {0, 60, "mm"},
           "from the chest wall to the plates' edges");
  s.number("compress.plate_width_mm", c.plate_width_mm, {20, 1000, "mm"},
           "of both plates, edges rounded like the rear ones; default endless");
  s.number("compress.plate_length_mm", c.plate_length_mm, {20, 1000, "mm"},
           "from the plates' rear to their front edges; default endless");
  s.number("compress.paddle_tilt_deg", c.paddle_tilt_deg, {-30, 30, "deg"},
           "of the paddle about its rear edge, positive: front lower");
  s.number("compress.paddle_spring_nm_per_deg", c.paddle_spring_nm_per_deg, {0.01, 100, "N m/deg"},
           "spring that a flexible paddle tilts against; default rigid");
  s.number("compress.paddle_pivot_mm", c.paddle_pivot_mm, {0, 500, "mm"},
           "from the rear edge to the axis of a flexible paddle");
  s.path("compress.paddle_stl", c.paddle_stl,
         "paddle as facets (STL, mm): x from the rear edge to the nipple, z into the breast");
  s.path("compress.support_stl", c.support_stl, "support as facets, the same");
  s.choice("compress.moving", c.options.moving,
           {{"both", Moving::both}, {"paddle", Moving::paddle}},
           "plates that press: both, or the paddle once the support has lifted the breast");
  s.number("compress.friction_coefficient", c.friction.coefficient, {0, 1},
           "Coulomb friction with the plates; 0: none. Dry skin: above 0.2, typically 0.5 "
           "(Derler, Gerhardt, Tribol. Lett. 45, 2012); on nylon 0.37 +- 0.09 (Zhang, Mak, "
           "Prosthet. Orthot. Int. 23, 1999)");
  s.number("compress.friction_slip_mm", c.friction.slip, {0.001, 1, "mm"},
           "slip up to which friction is elastic");
  s.number(
      "compress.most_force_n", c.most_force_n, {10, 1000, "N"},
      "where nobody says how thick the breast became, the paddle stops at this force if it "
      "comes before the thickness that is typical of the volume; Norway's screening recommends "
      "108 to 177 N");
  s.number("compress.gap_tolerance_mm", c.options.gap_tolerance, {0.02, 1, "mm"},
           "mean distance of plates from the skin that they press, weighed by pressure");
  s.number("compress.grad_div", c.options.solid.grad_div, {0, 100},
           "weight of the term that keeps each point's volume, over the shear modulus");
  s.number("compress.grad_div_quartic", c.options.solid.quartic, {0, 1000},
           "of that term, what grows with the fourth power; 0: none");
  s.flag("compress.gravity", c.standing_gravity,
         "the breast sags as the patient stands before the plates close");
  s.number("compress.pull", c.pull, {0, 10},
           "what holds the breast drawn forward onto the support, over its weight; at 1 it lies as "
           "far forward as it hung in the MRI; 0: nothing");
  s.number("compress.most_pull_n", c.most_pull_n, {0, 100, "N"},
           "of it, on what lay in front of the plates' edges in the MRI: a hand draws a large "
           "breast less far than its weight does");
  c.preset = kDefaultTissue;
  s.preset(
      "materials.preset", c.preset, tissue_presets(),
      "values for the tissues' laws, stiffness_factor, skin.membrane, the chest wall's spring and "
      "smoothing, compress.pull and compress.grad_div_quartic, where they are not given");
}

void declare_view(Settings& s, const std::string& view, ViewSettings& v) {
  const std::string prefix = "views." + view + ".";
  s.path(
      prefix + "mammogram", v.mammogram,
      "the view's mammogram (DICOM, also tomosynthesis; or PNG or JPEG with `detector` keys): the "
      "breast is brought to it");
  s.numbers(prefix + "nipple_pixel", v.nipple_pixel, {-20000, 20000, "pixels"},
            "column and row of the nipple in the mammogram; default: its marker, or what is found");
  s.points(prefix + "pectoral", v.pectoral, 2, {-20000, 20000, "pixels"},
           "two points, column and row, of the pectoral muscle's edge; default: what is found");
  s.path(prefix + "outline", v.outline,
         "the breast's skin line in the mammogram: a mask (PNG of its size) or a contour (text, a "
         "column and a row a line); default: what is found");
  s.number(
      prefix + "thickness_mm", v.thickness_mm, {10, 200, "mm", "is it in cm?"},
      "compressed thickness; default the DICOM mammogram's, else what is typical of the breast's "
      "volume");
  s.number(
      prefix + "angle_deg", v.angle_deg, {-90, 90, "deg"},
      "positioner angle: the beam runs from superior-medial to inferior-lateral; default the DICOM "
      "mammogram's, else 0 for CC and 45 for MLO");
  s.number(
      prefix + "turn_deg", v.turn_deg, {-45, 45, "deg"},
      "of the plates about the beam, from lateral towards depth; default: so that the breast comes "
      "out straight, as women are turned");
  s.number(prefix + "lift_mm", v.lift_mm, {-50, 50, "mm"},
           "how far the plates' middle lies above the breast's centroid");
  const std::string detector = prefix + "detector.";
  s.number(
      detector + "source_distance_mm", v.source_distance_mm, {300, 1500, "mm"},
      "X-ray source to detector; default the DICOM mammogram's, else 660; tomosynthesis slices: "
      "endless, their pixels have one size at any height");
  s.number(detector + "support_gap_mm", v.support_gap_mm, {0, 50, "mm"},
           "detector to the support's surface; default the DICOM mammogram's, else 0");
  s.number(detector + "pixel_spacing_mm", v.pixel_spacing_mm, {0.01, 2, "mm"},
           "on the detector (ImagerPixelSpacing); without it positions are in mm only");
  s.integer(detector + "columns", v.columns, {1, 20000}, "of the stored image");
  s.integer(detector + "rows", v.rows, {1, 20000}, "of the stored image");
  s.choice(detector + "chest_wall", v.chest_wall,
           {{"left", ImageEdge::left}, {"right", ImageEdge::right}},
           "image edge at the chest wall; default: left for a left breast");
  s.choice(detector + "lateral", v.lateral_at_top, {{"top", true}, {"bottom", false}},
           "image edge towards the patient's side (CC) or head (MLO); default: top");
  s.number(detector + "slice_spacing_mm", v.slice_spacing_mm, {0.3, 15, "mm"},
           "from slice to slice of a tomosynthesis volume; default its header's");
  s.number(detector + "lowest_slice_mm", v.lowest_slice_mm, {-20, 50, "mm"},
           "middle of the slice nearest to the support, above it; default half the spacing");
  s.choice(detector + "first_slice", v.first_slice_at_support,
           {{"support", true}, {"paddle", false}},
           "where slice 1 lies; default what the header's positions say");
}

}  // namespace mammotwin
