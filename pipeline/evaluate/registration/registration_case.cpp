#include "pipeline/evaluate/registration/registration_case.h"

#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "pipeline/evaluate/cases/patient_chain.h"
#include "pipeline/evaluate/registration/mri_faults.h"
#include "pipeline/evaluate/registration/spoilt_case.h"
#include "pipeline/frame/products.h"
#include "pipeline/patient/compression_settings.h"
#include "pipeline/synthesize/coil_pressed.h"
#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/nrrd_file.h"
#include "pipeline/synthesize/patient_files.h"
#include "pipeline/synthesize/views/true_mammogram.h"
#include "pipeline/synthesize/views/true_tomosynthesis.h"
#include "registration/carry/point_carrier.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uint64_t kSeed = 8051;
const Eigen::Vector3i kCoarse{3, 3, 1}, kCoarseTruth{4, 4, 1};
constexpr double kCoarseVoxel_mm = 1.8;
constexpr int kMostChests = 30;  // of the drawn build: not every chest carries every breast
/// Not mri.nrrd: `segment`, whose products stand in the same folder, leaves its part of the MRI
/// there.
constexpr const char* kScan = "scan.nrrd";
constexpr int kHardNumbers = 500;                                        // beyond these
constexpr double kNippleOff_mm = 10, kWallOff_mm = 5, kRegionCut = 0.1;  // of hard patients' MRI
constexpr double kCoilPress = 0.25;  // of a hard patient's width that a coil's plates take off
constexpr int kPoints = 20;          // landmarks beside the lesions

/// What a view is drawn from, each way.
struct ViewRanges {
  double roll_deg, turn_deg, lift_mm, shift_mm;
  double least_compressed, most_compressed;
  double laid_turn_deg, nipple_share;  // off what is usual, in MLO
};
constexpr ViewRanges kEasy{5, 4, 5, 15, 0.45, 0.58, 10, 0.1};
/// As radiographers differ at most, and not by a standard deviation.
constexpr ViewRanges kHard{15, 8, 8, 25, 0.4, 0.6, 20, 0.2};

DrawnView draw_view(CounterRandom& random, bool hard, const std::string& name, double angle_deg) {
  const ViewRanges& ranges = hard ? kHard : kEasy;
  const auto either_way = [&](double most) { return random.uniform(-most, most); };
  DrawnView view;
  view.name = name;
  view.header_angle_deg = angle_deg;
  view.roll_deg = either_way(ranges.roll_deg);
  view.turn_deg = either_way(ranges.turn_deg);
  view.lift_mm = either_way(ranges.lift_mm);
  view.clearance_mm = random.uniform(6, 16);
  view.shift_mm = either_way(ranges.shift_mm);
  view.compressed_fraction = random.uniform(ranges.least_compressed, ranges.most_compressed);
  if (!hard) {
    view.thickness_error_mm = random.uniform() < 0.5 ? -3 : 3;
    return view;
  }
  view.thickness_error_mm = either_way(8);
  view.edge_mm = random.uniform(-20, 15);  // of CC alone
  view.marker = random.uniform() < 0.5;
  return view;
}

/// How the MLO came to lie on its detector.
void lay_mlo(CounterRandom random, const ViewRanges& ranges, DrawnView& mlo) {
  mlo.laid_turn_deg += random.uniform(-ranges.laid_turn_deg, ranges.laid_turn_deg);
  mlo.nipple_share += random.uniform(-ranges.nipple_share, ranges.nipple_share);
}

/// Patient n, from n alone: body, tissue that is unlike the registering model's, and how each view
/// was taken. The law is in README.md. Coarse: few elements in the truth and in the model, so that
/// it takes seconds instead of minutes.
DrawnPatient draw_registration(int number, Difficulty difficulty, int attempt = 0) {
  const bool hard = difficulty == Difficulty::hard;
  number += hard ? kHardNumbers : 0;
  CounterRandom random(kSeed, number, 0), build(kSeed, number, 1000 * (attempt + 1));
  DrawnPatient drawn;
  if (difficulty == Difficulty::coarse) {
    drawn.true_elements = kCoarseTruth;
    drawn.elements = kCoarse;
    drawn.patient.scan.voxel_mm = kCoarseVoxel_mm;
  }
  AnatomyOptions& a = drawn.patient.anatomy;
  a.seed = kSeed * 1000 + number * 50 + attempt;
  a.side = random.uniform() < 0.5 ? Side::left : Side::right;
  a.volume_ml = random.uniform(350, 1000);
  a.density = random.uniform(0.1, 0.35);
  a.ptosis = random.uniform(0.1, 0.6);
  a.projection = build.uniform(1.2, 1.8);
  a.chest_half_width_mm = build.uniform(125, 150);
  a.lesions = 3;
  if (difficulty == Difficulty::fatty) {  // large lesions would be a pattern, too
    a.density = 0.01;
    a.lesions = 1;
    a.lesion_min_mm = 8;
    a.lesion_max_mm = 8.5;
  }
  drawn.patient.scan.contrast =
      number % 2 ? ScanContrast::not_suppressed : ScanContrast::fat_suppressed;
  const double factor = number % 2 ? 2 : 0.5;  // off what the registering model assumes
  const CompressionSettings assumed;
  drawn.tissue.stiffness_ratio = factor * assumed.fibroglandular.c1_kpa / assumed.fat.c1_kpa;
  drawn.views = {draw_view(random, hard, "cc", 0),
                 draw_view(random, hard, "mlo", random.uniform(40, 50))};
  lay_mlo({kSeed, static_cast<std::uint64_t>(number), 500}, hard ? kHard : kEasy, drawn.views[1]);
  if (hard) {
    drawn.tissue.stiffening = random.uniform(0.5, 2.5);
    drawn.tissue.springs = std::exp(random.uniform(std::log(0.4), std::log(4)));
    drawn.tissue.friction = random.uniform(0.15, 0.6);
    drawn.tissue.paddle_tilt_deg = random.uniform(-1, 5);
  }
  return drawn;
}

SyntheticPatient make_drawn(int number, Difficulty difficulty, DrawnPatient& drawn) {
  for (int attempt = 0;; ++attempt) {
    drawn = draw_registration(number, difficulty, attempt);
    try {
      return make_patient(drawn.patient);
    } catch (const std::invalid_argument&) {
      if (attempt + 1 == kMostChests) throw;
    }
  }
}

struct Landmark3d {
  std::string name;
  Eigen::Vector3d prone_in_lps;
};

/// The lesions, and voxels of gland, or of fat in a fatty breast, drawn evenly from the breast in
/// front of the chest wall.
std::vector<Landmark3d> landmarks_of(const Segmentation& truth, int number, bool fatty) {
  std::vector<Landmark3d> all;
  for (const Lesion& lesion : truth.lesions) all.push_back({lesion.id, lesion.centroid_in_lps});
  CounterRandom random(number, 77);
  const auto& f = truth.fractions;
  while (all.size() < truth.lesions.size() + kPoints) {
    const Eigen::Vector3i v(static_cast<int>(random.uniform(0, f.size.x())),
                            static_cast<int>(random.uniform(0, f.size.y())),
                            static_cast<int>(random.uniform(0, f.size.z())));
    const Fractions& here = f(v.x(), v.y(), v.z());
    if ((fatty ? here.fat : here.fibroglandular) > 0.7)
      all.push_back({"P" + std::to_string(all.size()), f.position(v.x(), v.y(), v.z())});
  }
  return all;
}

/// `imaged`: the breast as the MRI shows it.
std::string landmark_table(const TrueBreast& breast, const HermiteMesh& imaged,
                           const std::vector<TrueView>& views, const Detector& detector, int number,
                           bool fatty) {
  const PointCarrier to_image(breast.prone(), imaged);
  std::ostringstream csv;
  csv << "name,mri_l_mm,mri_p_mm,mri_s_mm,cc_column,cc_row,mlo_column,mlo_row\n"
      << std::fixed << std::setprecision(3);
  for (const Landmark3d& l : landmarks_of(breast.truth(), number, fatty)) {
    csv << l.name;
    for (const double x : to_image.carry(l.prone_in_lps).in_lps) csv << "," << x;
    for (const TrueView& view : views)
      for (const double x : true_mark(breast, view, detector, l.prone_in_lps)) csv << "," << x;
    csv << "\n";
  }
  return csv.str();
}

/// Body, MRI and lesions, without views.
std::string body_toml(const SyntheticPatient& patient, const DrawnPatient& drawn) {
  std::string text = patient_toml(patient);
  const std::string own = "\"mri.nrrd\"";
  text.replace(text.find(own), own.size(), std::string("\"") + kScan + "\"");
  std::ostringstream toml;
  if (const auto& e = drawn.elements)
    toml << "fit.elements = [" << e->x() << ", " << e->y() << ", " << e->z() << "]\n";
  toml << text.substr(0, text.find("[views.cc]"));
  return toml.str();
}

/// Keys for what is found wrongly in patient n's MRI, and their files. The law is in README.md.
std::string wrongly_found(const SyntheticPatient& imaged, const Segmentation& truth, int number,
                          const fs::path& folder) {
  std::ostringstream toml;
  const auto say = [&](const std::string& what, const json& markups) {
    write_text_atomically(folder / (what + ".mrk.json"), markups.dump(1) + "\n");
    toml << what << ".markups = \"" << what << ".mrk.json\"\n";
  };
  if (number % 2) {
    const Eigen::Vector3d at =
        imaged.truth.nipple_in_lps + kNippleOff_mm * Eigen::Vector3d::UnitZ();
    toml << "nipple.point_lps_mm = [" << at.x() << ", " << at.y() << ", " << at.z() << "]\n";
  }
  if (number % 4 == 1 || number % 4 == 2)
    say("chest_wall", wall_off_laterally(truth, number % 4 == 1 ? kWallOff_mm : -kWallOff_mm));
  if (number % 5 == 2) say("region", region_without_flank(truth, kRegionCut));
  return toml.str();
}

/// What lies over or beside the breast in patient n's mammograms.
void draw_over(int number, const fs::path& folder) {
  if (number % 3 == 0) add_abdomen(folder / "mlo.png");
  if (number % 5 == 4) add_skin_fold(folder / "cc.png", false);
  if (number % 5 == 1) add_skin_fold(folder / "mlo.png", true);
}

std::string views_toml(const DrawnPatient& drawn, const std::vector<TrueView>& views,
                       const Detector& detector) {
  std::ostringstream toml;
  for (std::size_t n = 0; n < views.size(); ++n) {
    const std::string key = "[views." + views[n].view.name;
    toml << key << "]\nmammogram = \"" << views[n].view.name
         << ".png\"\nthickness_mm = " << views[n].header_thickness_mm
         << "\nangle_deg = " << drawn.views[n].header_angle_deg << "\n"
         << key << ".detector]\npixel_spacing_mm = " << detector.pixels->spacing_mm
         << "\ncolumns = " << detector.pixels->columns << "\nrows = " << detector.pixels->rows
         << "\n\n";
  }
  return toml.str();
}

json drawn_json(const DrawnPatient& drawn, const std::vector<TrueView>& views) {
  json all{{"stiffness_ratio", drawn.tissue.stiffness_ratio},
           {"stiffening", drawn.tissue.stiffening},
           {"springs", drawn.tissue.springs},
           {"friction", drawn.tissue.friction},
           {"volume_ml", drawn.patient.anatomy.volume_ml},
           {"density", drawn.patient.anatomy.density}};
  for (std::size_t n = 0; n < views.size(); ++n) {
    const DrawnView& v = drawn.views[n];
    all[v.name] = {{"roll_deg", v.roll_deg},
                   {"turn_deg", v.turn_deg},
                   {"lift_mm", v.lift_mm},
                   {"clearance_mm", v.clearance_mm},
                   {"shift_mm", v.shift_mm},
                   {"marker", v.marker},
                   {"thickness_mm", views[n].view.thickness_mm},
                   {"header_thickness_mm", views[n].header_thickness_mm}};
    if (is_oblique(v.header_angle_deg))
      all[v.name].update({{"laid_turn_deg", v.laid_turn_deg}, {"nipple_share", v.nipple_share}});
    else
      all[v.name]["edge_mm"] = v.edge_mm;
  }
  return all;
}

}  // namespace

void make_registration_case(int number, Difficulty difficulty, const fs::path& folder) {
  if (fs::exists(folder / "patient.toml")) return;
  fs::create_directories(folder);
  DrawnPatient drawn;
  SyntheticPatient patient = make_drawn(number, difficulty, drawn);
  const TrueBreast breast(patient, drawn);
  const Detector detector = synthetic_detector(drawn.patient.anatomy.side);
  const bool hard = difficulty == Difficulty::hard, in_coil = hard && number % 5 == 3;
  const HermiteMesh imaged = in_coil ? breast.between_coil_plates(kCoilPress) : breast.prone();
  if (in_coil) patient = imaged_pressed(std::move(patient), breast.prone(), imaged);
  std::vector<TrueView> views;
  for (const DrawnView& view : drawn.views) views.push_back(breast.compress_view(view));
  for (const TrueView& view : views)
    write_png(folder / (view.view.name + ".png"),
              true_mammogram(breast, view, detector, drawn.patient.anatomy.seed));
  if (hard) draw_over(number, folder);
  write_nrrd(folder / kScan, patient.scan.image);
  write_text_atomically(
      folder / "landmarks.csv",
      landmark_table(breast, imaged, views, detector, number, difficulty == Difficulty::fatty));
  write_text_atomically(folder / "drawn.json", drawn_json(drawn, views).dump(1) + "\n");
  write_text_atomically(folder / "patient.toml",
                        (hard ? wrongly_found(patient, breast.truth(), number, folder) : "") +
                            body_toml(patient, drawn) + views_toml(drawn, views, detector));
}

void make_tomosynthesis_case(bool coarse, const fs::path& folder) {
  constexpr int kPatient = 42;
  if (fs::exists(folder / "patient.toml")) return;
  fs::create_directories(folder);
  DrawnPatient drawn = draw_registration(kPatient, coarse ? Difficulty::coarse : Difficulty::easy);
  const double voxel_mm = drawn.patient.scan.voxel_mm;
  drawn.patient = PatientOptions();
  drawn.patient.anatomy.seed = kPatient;
  if (coarse) drawn.patient.scan.voxel_mm = voxel_mm;
  const SyntheticPatient patient = make_patient(drawn.patient);
  const TrueBreast breast(patient, drawn);
  std::vector<TrueView> views;
  Detector detector;
  json slices;
  std::string toml = body_toml(patient, drawn);
  for (const DrawnView& drawn_view : drawn.views) {
    views.push_back(breast.compress_view(drawn_view));
    const TrueView& view = views.back();
    const TomosynthesisVolume volume = true_tomosynthesis(breast, view, kPatient);
    detector = detector_of(volume, view.view.side);
    slices["spacing_mm"] = volume.stack.spacing_mm;
    slices["pixel_mm"] = volume.pixel_mm;
    const std::string file = view.view.name + ".dcm";
    write_tomosynthesis(folder / file, volume, view.view, drawn_view.header_angle_deg,
                        view.header_thickness_mm);
    for (const Lesion& lesion : breast.truth().lesions)
      slices[view.view.name][lesion.id] =
          volume.stack.slice_at(true_place(breast, view, lesion.centroid_in_lps).z());
    toml += "[views." + view.view.name + "]\nmammogram = \"" + file + "\"\n\n";
  }
  write_nrrd(folder / kScan, patient.scan.image);
  write_text_atomically(folder / "landmarks.csv",
                        landmark_table(breast, breast.prone(), views, detector, kPatient, false));
  write_text_atomically(folder / "slices.json", slices.dump(1) + "\n");
  write_text_atomically(folder / "drawn.json", drawn_json(drawn, views).dump(1) + "\n");
  write_text_atomically(folder / "patient.toml", toml);
}

void take_tissue(const std::string& preset, const fs::path& folder) {
  const fs::path file = folder / "patient.toml";
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::regex named("materials\\.preset = [^\n]*");  // with its remark
  write_text_atomically(file,
                        std::regex_replace(text, named, "materials.preset = \"" + preset + "\""));
}

void run_registration_case(const fs::path& folder) {
  run_patient_chain(folder / "patient.toml", folder);
}

}  // namespace mammotwin
