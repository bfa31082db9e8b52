#include "registration/mammogram/header_geometry.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "registration/view/view_frame.h"

namespace mammotwin {
namespace {

// Tags as a message names them.
constexpr const char* kModality = "(0008,0060) Modality";
constexpr const char* kIntent = "(0008,0068) PresentationIntentType";
constexpr const char* kDistance = "(0018,1110) DistanceSourceToDetector";
constexpr const char* kToPatient = "(0018,1111) DistanceSourceToPatient";
constexpr const char* kMagnification = "(0018,1114) EstimatedRadiographicMagnificationFactor";
constexpr const char* kImageType = "(0008,0008) ImageType";
constexpr const char* kCollimator = "(0018,1702) and (0018,1704) Collimator edges";
constexpr const char* kElementSpacing = "(0018,7022) DetectorElementSpacing";
constexpr const char* kImagerSpacing = "(0018,1164) ImagerPixelSpacing";
constexpr const char* kThickness = "(0018,11A0) BodyPartThickness";
constexpr const char* kForce = "(0018,11A2) CompressionForce";
constexpr const char* kPaddle = "(0018,11A4) PaddleDescription";
constexpr const char* kPositioner = "(0018,1508) PositionerType";
constexpr const char* kAngle = "(0018,1510) PositionerPrimaryAngle";
constexpr const char* kView = "(0018,5101) ViewPosition";
constexpr const char* kOrientation = "(0020,0020) PatientOrientation";
constexpr const char* kLaterality = "(0020,0062) ImageLaterality";
constexpr const char* kFrames = "(0028,0008) NumberOfFrames";
constexpr const char* kSize = "(0028,0010) Rows or (0028,0011) Columns";
constexpr const char* kPixelSpacing = "(0028,0030) PixelSpacing";
constexpr const char* kImplant = "(0028,1300) BreastImplantPresent";
constexpr const char* kPartial = "(0028,1350) PartialView";
constexpr const char* kViewCode = "(0054,0220) ViewCodeSequence";
constexpr const char* kModifier = "(0054,0222) ViewModifierCodeSequence";

[[noreturn]] void refuse(const std::string& tag, const std::string& what) {
  throw std::runtime_error(tag + " " + what);
}

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

bool has(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

/// A word of `text` begins so: MAG in "MAG 1.8" and not in IMAGING.
bool has_word(const std::string& text, const std::string& word) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if (at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]))) return true;
  return false;
}

/// CC and MLO in SNOMED RT and SNOMED CT (PS3.16 CID 4014).
const std::map<std::string, std::string> kViewCodes{
    {"R-10242", "CC"}, {"399162004", "CC"}, {"R-10226", "MLO"}, {"399368009", "MLO"}};

std::string coded_view(const MammogramHeader& h) {
  const auto known = kViewCodes.find(h.view_code);
  if (known != kViewCodes.end()) return known->second;
  return h.view_code.empty() ? "" : "\"" + h.view_code_meaning + "\"";
}

void check_kind(const MammogramHeader& h, HeaderGeometry& geometry) {
  if (h.modality != "MG") refuse(kModality, "is \"" + h.modality + "\"; expected MG, a mammogram");
  if (!h.positioner_type.empty() && h.positioner_type.rfind("MAMMOGRAPHIC", 0) != 0)
    geometry.remarks.push_back(std::string(kPositioner) + " is \"" + h.positioner_type +
                               "\"; expected MAMMOGRAPHIC");
  if (h.frames && *h.frames > 1 && !h.slices)
    refuse(kFrames, "is " + std::to_string(*h.frames) +
                        ", and the file is no Breast Tomosynthesis Image; expected one image or "
                        "such a volume: projections and other series of frames cannot be used");
  if (h.slices && h.frames.value_or(1) < 2)
    refuse(kFrames, "is 1; expected all slices of a tomosynthesis volume");
  if (h.implant == "YES") refuse(kImplant, "is YES: the model knows no implant");
  if (h.partial_view == "YES") refuse(kPartial, "is YES: a partial view has no outline to match");
  if (h.presentation_intent.empty())
    geometry.remarks.push_back(std::string(kIntent) + " is missing; taken as FOR PRESENTATION");
}

/// What is a mammogram, but not the plain view that the search was tried on.
void remark_on_kind(const MammogramHeader& h, HeaderGeometry& geometry) {
  const std::pair<const char*, const char*> kinds[] = {
      {"SUBTRACT", "a contrast-enhanced subtraction: fat is not dark in it as in a plain view"},
      {"RECOMBINED", "a contrast-enhanced subtraction: fat is not dark in it as in a plain view"},
      {"GENERATED_2D", "a synthetic 2-D view computed from tomosynthesis"},
      {"STEREO", "one of a stereo pair, taken at another angle"}};
  for (const std::string& type : h.image_type)
    for (const auto& [word, meaning] : kinds)
      if (has(type, word))
        geometry.remarks.push_back(std::string(kImageType) + " says " + type + ": " + meaning);
  constexpr double kLittle = 0.8;  // of the columns: more is cut off than a border
  if (h.collimated_left && h.collimated_right && h.columns &&
      *h.collimated_right - *h.collimated_left < kLittle * *h.columns)
    geometry.remarks.push_back(
        std::string(kCollimator) +
        " leave less than 80 % of the columns: heavy collimation may cut the "
        "outline");
}

void check_enlargement(const MammogramHeader& h) {
  constexpr double most = 1.15;  // contact views: 1.0 to 1.1
  if (h.magnification && *h.magnification > most)
    refuse(kMagnification,
           "is " + text_of(*h.magnification) + ": a magnification view cannot be used");
  for (const std::string& modifier : h.view_modifiers)
    for (const char* bad : {"MAGNIFICATION", "SPOT", "IMPLANT", "TANGENTIAL", "ROLLED", "CLEAVAGE"})
      if (has(modifier, bad))
        refuse(kModifier, "says \"" + modifier + "\": such a view cannot be used");
  for (const char* bad : {"SPOT", "MAG"})
    if (has_word(h.paddle, bad))
      refuse(kPaddle, "is \"" + h.paddle + "\": such a view cannot be used");
}

void check_view(const MammogramHeader& h, const std::string& view) {
  const std::string coded = coded_view(h);
  std::string said = h.view_position;
  if (said.empty()) said = coded;
  if (said.empty()) refuse(kView, std::string("is missing, and so is ") + kViewCode);
  if (!h.view_position.empty() && !coded.empty() && coded != h.view_position)
    refuse(kView, "is " + h.view_position + ", but " + kViewCode + " says " + coded);
  std::string asked = view;
  std::transform(asked.begin(), asked.end(), asked.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  if (said != asked) refuse(kView, "is " + said + "; patient.toml gives this file as " + asked);
}

void check_side(const MammogramHeader& h, Side side) {
  if (!h.image_laterality.empty() && !h.laterality.empty() && h.image_laterality != h.laterality)
    refuse(kLaterality,
           "is " + h.image_laterality + ", but (0020,0060) Laterality is " + h.laterality);
  const std::string said = h.image_laterality.empty() ? h.laterality : h.image_laterality;
  if (said != "L" && said != "R")
    refuse(kLaterality, said.empty() ? "is missing, and so is (0020,0060) Laterality"
                                     : "is \"" + said + "\"; expected L or R");
  const std::string asked = side == Side::left ? "L" : "R";
  if (said != asked)
    refuse(kLaterality, "is " + said + "; the MRI's breast is the " +
                            (side == Side::left ? "left" : "right") + " one");
}

/// Vendors differ in the sign; a view is what it says, so only the size is taken.
double angle_of(const MammogramHeader& h, const std::string& view, HeaderGeometry& geometry) {
  constexpr double most_cc = 15, least_mlo = 20, most_mlo = 75, usual_mlo = 45;  // [deg]
  const bool cc = view == "cc";
  if (!h.primary_angle_deg) {
    geometry.remarks.push_back(std::string(kAngle) + " is missing; taken as " + (cc ? "0" : "45"));
    return cc ? 0 : usual_mlo;
  }
  double size = std::abs(*h.primary_angle_deg);
  if (size > 180) size = 360 - size;
  if (cc && size <= most_cc) return *h.primary_angle_deg == 0 ? 0 : size;
  if (!cc && size >= least_mlo && size <= most_mlo) return size;
  refuse(kAngle, "is " + text_of(*h.primary_angle_deg) + "; expected " +
                     (cc ? "-15 to 15 for CC" : "20 to 75, of either sign, for MLO") + "; views." +
                     view + ".angle_deg overrides it");
}

std::optional<double> thickness_of(const MammogramHeader& h, const std::string& view,
                                   HeaderGeometry& geometry) {
  if (!h.thickness_mm) {
    geometry.remarks.push_back(std::string(kThickness) + " is missing");
    return std::nullopt;
  }
  if (*h.thickness_mm >= 15 && *h.thickness_mm <= 130) return h.thickness_mm;
  refuse(kThickness, "is " + text_of(*h.thickness_mm) + "; expected 15 to 130 mm" +
                         (*h.thickness_mm > 1.5 && *h.thickness_mm < 13 ? " (is it in cm?)" : "") +
                         "; views." + view + ".thickness_mm overrides it");
}

/// N; below what presses a breast but plausible in dN is taken as that.
std::optional<double> force_of(const MammogramHeader& h, HeaderGeometry& geometry) {
  if (!h.force) return std::nullopt;
  if (*h.force >= 25 && *h.force <= 300) return h.force;
  if (*h.force >= 2.5 && *h.force < 25) {
    geometry.remarks.push_back(std::string(kForce) + " is " + text_of(*h.force) +
                               "; taken as dN, as one vendor writes it");
    return 10 * *h.force;
  }
  geometry.remarks.push_back(std::string(kForce) + " is " + text_of(*h.force) +
                             "; expected 25 to 300 N, so it is not used");
  return std::nullopt;
}

double distance_of(const MammogramHeader& h, const std::string& view, HeaderGeometry& geometry) {
  if (h.slices) return kParallel_mm;
  if (!h.source_to_detector_mm) {
    geometry.remarks.push_back(std::string(kDistance) + " is missing; taken as " +
                               text_of(Detector{}.source_distance_mm) + " mm");
    return Detector{}.source_distance_mm;
  }
  if (*h.source_to_detector_mm < 550 || *h.source_to_detector_mm > 800)
    refuse(kDistance, "is " + text_of(*h.source_to_detector_mm) +
                          "; expected 550 to 800 mm; views." + view +
                          ".detector.source_distance_mm overrides it");
  return *h.source_to_detector_mm;
}

/// One vendor's DistanceSourceToPatient ends at the breast's top (25 mm of breast and a gap of 43:
/// 18 mm of support), which a gap beyond any usual support tells.
double gap_of(const MammogramHeader& h, double distance, std::optional<double> thickness,
              HeaderGeometry& geometry) {
  if (h.slices) return 0;
  constexpr double kUsual = 30, kMost = 50;  // [mm] of supports over detectors
  if (!h.source_to_patient_mm) return 0;
  const double gap = distance - *h.source_to_patient_mm;
  if (thickness && gap > kUsual && gap >= *thickness && gap - *thickness <= kUsual) {
    geometry.remarks.push_back(std::string(kToPatient) + " is " + text_of(*h.source_to_patient_mm) +
                               ", which seems to end at the breast's top; taken as a support " +
                               text_of(gap - *thickness) + " mm above the detector");
    return gap - *thickness;
  }
  if (gap >= 0 && gap <= kMost) return gap;
  geometry.remarks.push_back(std::string(kToPatient) + " is " + text_of(*h.source_to_patient_mm) +
                             ", which is no support 0 to 50 mm above the detector; taken as 0");
  return 0;
}

double square(const char* tag, const std::vector<double>& spacing, const std::string& view) {
  const std::string how = "; views." + view + ".detector.pixel_spacing_mm overrides it";
  if (spacing.size() != 2 || std::abs(spacing[0] - spacing[1]) > 1e-4)
    refuse(tag, "is not one number twice, so pixels are not square" + how);
  if (spacing[0] < 0.02 || spacing[0] > 0.5)
    refuse(tag, "is " + text_of(spacing[0]) + "; expected 0.02 to 0.5 mm" + how);
  return spacing[0];
}

double spacing_of(const MammogramHeader& h, const std::string& view, HeaderGeometry& geometry) {
  if (h.slices) {
    if (h.pixel_spacing_mm.empty())
      refuse(kPixelSpacing, "is missing; views." + view + ".detector.pixel_spacing_mm replaces it");
    return square(kPixelSpacing, h.pixel_spacing_mm, view);
  }
  if (h.imager_spacing_mm.empty() && h.pixel_spacing_mm.empty())
    refuse(kImagerSpacing, std::string("is missing, and so is ") + kPixelSpacing + "; views." +
                               view + ".detector.pixel_spacing_mm replaces them");
  if (h.imager_spacing_mm.empty()) {
    geometry.remarks.push_back(std::string(kImagerSpacing) + " is missing; taken from " +
                               kPixelSpacing + ", which may be calibrated to the breast's plane");
    return square(kPixelSpacing, h.pixel_spacing_mm, view);
  }
  const double spacing = square(kImagerSpacing, h.imager_spacing_mm, view);
  if (!h.element_spacing_mm.empty()) {
    // At the breast's plane a pixel is smaller by magnification, 2 to 15 %; binning doubles it.
    const double element = h.element_spacing_mm[0], ratio = element / spacing;
    if (ratio > 1.02 && ratio < 1.15) {
      geometry.remarks.push_back(std::string(kElementSpacing) + " is " + text_of(element) + ", " +
                                 kImagerSpacing + " " + text_of(spacing) +
                                 ", as if on the breast's plane; the former is used, on the "
                                 "detector's");
      return square(kElementSpacing, h.element_spacing_mm, view);
    }
  }
  if (!h.pixel_spacing_mm.empty() && std::abs(h.pixel_spacing_mm[0] / spacing - 1) > 0.01)
    geometry.remarks.push_back(std::string(kPixelSpacing) + " differs from " + kImagerSpacing +
                               "; the latter is used, on the detector's plane");
  return spacing;
}

ImageEdge chest_wall_of(const MammogramHeader& h, const std::string& view) {
  const std::string rows = h.patient_orientation.empty() ? "" : h.patient_orientation[0];
  if (rows.starts_with("A")) return ImageEdge::left;  // the longest component comes first
  if (rows.starts_with("P")) return ImageEdge::right;
  refuse(kOrientation,
         (rows.empty() ? "is missing" : "begins with \"" + rows + "\"; expected A or P") +
             "; views." + view + ".detector.chest_wall and lateral replace it");
}

/// Columns run down: to the feet in MLO, medially in CC, as mammograms are hung.
bool lateral_at_top_of(const MammogramHeader& h, const std::string& view, Side side) {
  const std::string down = h.patient_orientation.size() < 2 ? "" : h.patient_orientation[1];
  const char lateral = side == Side::left ? 'L' : 'R', medial = side == Side::left ? 'R' : 'L';
  const char first = down.empty() ? ' ' : down[0];
  const bool cc = view == "cc";
  if (cc && first == medial) return true;
  if (cc && first == lateral) return false;
  if (!cc && (first == 'F' || has(down, "F"))) return true;
  if (!cc && (first == 'H' || has(down, "H"))) return false;
  refuse(kOrientation, "has no second value that fits " +
                           std::string(cc ? "CC (L or R)" : "MLO (F or H)") + "; views." + view +
                           ".detector.chest_wall and lateral replace it");
}

}  // namespace

std::string view_said_in(const MammogramHeader& h) {
  std::string view = h.view_position.empty() ? coded_view(h) : h.view_position;
  std::transform(view.begin(), view.end(), view.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return view;
}

Side side_said_in(const MammogramHeader& h) {
  const std::string said = h.image_laterality.empty() ? h.laterality : h.image_laterality;
  return said == "R" ? Side::right : Side::left;
}

HeaderGeometry header_geometry(const MammogramHeader& h, const std::string& view, Side side,
                               const HeaderOverrides& o) {
  HeaderGeometry g;
  check_kind(h, g);
  remark_on_kind(h, g);
  check_enlargement(h);
  check_view(h, view);
  check_side(h, side);
  g.angle_deg = o.angle_deg ? *o.angle_deg : angle_of(h, view, g);
  g.thickness_mm = o.thickness_mm ? o.thickness_mm : thickness_of(h, view, g);
  g.force_N = force_of(h, g);
  g.detector.source_distance_mm =
      o.source_distance_mm ? *o.source_distance_mm : distance_of(h, view, g);
  g.detector.support_gap_mm = o.support_gap_mm
                                  ? *o.support_gap_mm
                                  : gap_of(h, g.detector.source_distance_mm, g.thickness_mm, g);
  if (!h.rows || !h.columns || *h.rows < 1 || *h.columns < 1) refuse(kSize, "is missing");
  PixelGrid grid;
  grid.columns = *h.columns;
  grid.rows = *h.rows;
  grid.spacing_mm = o.pixel_spacing_mm ? *o.pixel_spacing_mm : spacing_of(h, view, g);
  grid.chest_wall = o.chest_wall ? *o.chest_wall : chest_wall_of(h, view);
  grid.lateral_at_top = o.lateral_at_top ? *o.lateral_at_top : lateral_at_top_of(h, view, side);
  g.detector.pixels = grid;
  if (h.slices)
    g.detector.slices = tomosynthesis_slices(h, view_axes(side, g.angle_deg).row(2), g.thickness_mm,
                                             o.slices, view, g.remarks);
  check_detector(g.detector);
  return g;
}

}  // namespace mammotwin
