#include "pipeline/evaluate/segmentation/segmentation_cases.h"

#include <stdexcept>

#include "pipeline/evaluate/cases/label_maps.h"
#include "pipeline/synthesize/map_patient.h"
#include "segmentation/files/read_labels.h"

namespace mammotwin {
namespace {

/// Number n of `count` steps from low to high, taken in strides of `step`.
double spread(int n, double low, double high, int step, int count) {
  return low + (high - low) * ((n * step) % count) / (count - 1.0);
}

PatientOptions drawn_options(int n) {
  PatientOptions options;
  options.anatomy.seed = 1000 + n;
  options.anatomy.side = n / 2 % 2 ? Side::right : Side::left;
  options.anatomy.volume_ml = spread(n, 300, 1200, 3, 7);
  options.anatomy.density = spread(n, 0.08, 0.4, 2, 5);
  options.anatomy.skin_mm = spread(n, 1.0, 3.0, 5, 9);
  options.anatomy.ptosis = spread(n, 0, 0.8, 2, 5);
  options.anatomy.pectoral_mm = spread(n, 10, 25, 3, 4);
  options.scan.contrast = n % 2 ? ScanContrast::not_suppressed : ScanContrast::fat_suppressed;
  options.scan.noise = spread(n, 0.03, 0.08, 1, 6);
  return options;
}

/// Not every chest can carry every volume: the nearest larger one that this chest can is taken.
SyntheticPatient make_possible(PatientOptions options) {
  constexpr double larger = 1.15, largest_ml = 1500;
  for (;;) {
    try {
      return make_patient(options);
    } catch (const std::invalid_argument&) {
      options.anatomy.volume_ml *= larger;
      if (options.anatomy.volume_ml > largest_ml) throw;
    }
  }
}

ScanOptions map_scan(int n, ScanContrast contrast) {
  ScanOptions scan;
  scan.contrast = contrast;
  scan.noise = spread(n, 0.03, 0.08, 3, 10);
  scan.shading = contrast == ScanContrast::fat_suppressed ? 1.2 : 1;  // 1:5 to 1:7 in these bodies
  return scan;
}

std::function<SyntheticPatient()> scan_of(const LabelMapBreast& breast, int n,
                                          const ScanOptions& scan) {
  const auto seed = static_cast<std::uint64_t>(2000 + n);
  return [breast, scan, seed] {
    const MapBody body = body_of_map(read_labels(breast.file), label_map_values(), seed);
    return make_map_patient(body, breast.side, scan, seed);
  };
}

SegmentationCase case_of(const LabelMapBreast& breast, int n, ScanContrast contrast) {
  const std::string side = breast.side == Side::left ? "-left-" : "-right-";
  return {breast.exam + side + name_of(contrast), contrast,
          scan_of(breast, n, map_scan(n, contrast))};
}

/// The same body imaged before and after contrast agent.
SegmentationCase pre_post_case_of(const LabelMapBreast& breast, int n) {
  SegmentationCase c = case_of(breast, n, ScanContrast::not_suppressed);
  c.name += "-pre_post";
  c.make_pre = c.make;
  ScanOptions after = map_scan(n, ScanContrast::not_suppressed);
  after.contrast_agent = true;
  c.make = scan_of(breast, n, after);
  return c;
}

SegmentationCase drawn_pre_post(const SegmentationCase& drawn, PatientOptions options) {
  options.scan.contrast_agent = true;
  return {drawn.name + "-pre_post", drawn.contrast, [options] { return make_possible(options); },
          drawn.make};
}

}  // namespace

std::vector<SegmentationCase> varied_cases(const std::filesystem::path& folder) {
  struct Variation {
    const char *exam, *name;
    Side side;
    ScanOptions scan;
    double plates = 0;  ///< share of the breast's half width between coil plates; 0: none
  };
  std::vector<Variation> all;
  const auto add = [&](const char* exam, Side side, const char* name) -> Variation& {
    return all.emplace_back(Variation{
        exam, name, side, map_scan(static_cast<int>(all.size()), ScanContrast::fat_suppressed)});
  };
  constexpr Side left = Side::left, right = Side::right;
  add("Exam_04", left, "muscle_0.6").scan.muscle_to_fat = 0.6;
  add("Exam_07", right, "muscle_0.8").scan.muscle_to_fat = 0.8;
  add("Exam_08", left, "muscle_1.0").scan.muscle_to_fat = 1.0;
  add("Exam_14", right, "muscle_1.2").scan.muscle_to_fat = 1.2;
  add("Exam_18", left, "muscle_1.6").scan.muscle_to_fat = 1.6;
  add("Exam_18", left, "muscle_2.8").scan.muscle_to_fat = 2.8;
  add("Exam_21", right, "bright_organs").scan.organs_to_fat = 2.2;
  add("Exam_15", left, "ghosts").scan.ghosts = 0.12;
  add("Exam_04", right, "plates").plates = 0.85;
  add("Exam_18", right, "voxel_0.75").scan.voxel_mm = 0.75;
  add("Exam_07", left, "voxel_1.3").scan.voxel_mm = 1.3;
  const auto add_not_suppressed = [&](const char* exam, Side side, const char* name) -> auto& {
    Variation& v = add(exam, side, name);
    v.scan = map_scan(static_cast<int>(all.size()), ScanContrast::not_suppressed);
    return v;
  };
  add_not_suppressed("Exam_21", left, "muscle_0.6").scan.muscle_to_fat = 0.6;
  add("Exam_15", right, "vessels").scan.vessels_to_fat = 4;
  add("Exam_08", right, "vessels").scan.vessels_to_fat = 3;
  add("Exam_14", left, "vessels").scan.vessels_to_fat = 2.5;
  Variation& two_images = add_not_suppressed("Exam_08", left, "vessels-pre_post");
  two_images.scan.vessels_to_fat = 1.6;
  two_images.scan.contrast_agent = true;

  std::vector<SegmentationCase> cases;
  for (const LabelMapBreast& breast : label_map_breasts(folder))
    for (std::size_t n = 0; n < all.size(); ++n) {
      const Variation& v = all[n];
      if (breast.exam != v.exam || breast.side != v.side) continue;
      const auto seed = 3000 + n;
      SegmentationCase c = case_of(breast, static_cast<int>(n), v.scan.contrast);
      c.name += std::string("-") + v.name;
      c.varied = true;
      const auto image = [breast, plates = v.plates, seed](const ScanOptions& scan) {
        MapBody body = body_of_map(read_labels(breast.file), label_map_values(), seed);
        if (plates > 0) press_between_plates(body, plates);
        return make_map_patient(body, breast.side, scan, seed);
      };
      c.make = [image, scan = v.scan] { return image(scan); };
      if (v.scan.contrast_agent)
        c.make_pre = [image, scan = v.scan]() mutable {
          scan.contrast_agent = false;
          return image(scan);
        };
      cases.push_back(std::move(c));
    }
  return cases;
}

std::vector<SegmentationCase> drawn_cases(int count) {
  std::vector<SegmentationCase> cases;
  for (int n = 0; n < count; ++n) {
    const PatientOptions options = drawn_options(n);
    cases.push_back({"seed-" + std::to_string(options.anatomy.seed), options.scan.contrast,
                     [options] { return make_possible(options); }});
    if (options.scan.contrast == ScanContrast::not_suppressed)
      cases.push_back(drawn_pre_post(cases.back(), options));
  }
  return cases;
}

std::vector<SegmentationCase> label_map_cases(const std::filesystem::path& folder) {
  std::vector<SegmentationCase> cases;
  int n = 0;
  for (const LabelMapBreast& breast : label_map_breasts(folder)) {
    for (const ScanContrast contrast : {ScanContrast::fat_suppressed, ScanContrast::not_suppressed})
      cases.push_back(case_of(breast, n, contrast));
    cases.push_back(pre_post_case_of(breast, n));
    ++n;
  }
  return cases;
}

}  // namespace mammotwin
