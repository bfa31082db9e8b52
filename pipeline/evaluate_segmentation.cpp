// evaluate-segmentation: segments synthetic patients whose truth is known -> one table.

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/synthesize/patient.h"
#include "segmentation/score.h"
#include "segmentation/segment.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path table;
  int synthetic = 20;
};

void declare(CLI::App& app, Arguments& args) {
  app.add_option("table", args.table, "segmentation.json to write")->required();
  app.add_option("--synthetic", args.synthetic, "synthetic patients, each of another seed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

/// Patients that differ in everything the study found to matter, spread evenly over the seeds by
/// steps that do not divide each other.
PatientOptions options_of(int n) {
  const auto spread = [n](double low, double high, int step, int count) {
    return low + (high - low) * ((n * step) % count) / (count - 1.0);
  };
  PatientOptions options;
  options.anatomy.seed = 1000 + n;
  options.anatomy.side = n / 2 % 2 ? Side::right : Side::left;
  options.anatomy.volume_ml = spread(300, 1200, 3, 7);
  options.anatomy.density = spread(0.08, 0.4, 2, 5);
  options.anatomy.skin_mm = spread(1.0, 3.0, 5, 9);
  options.anatomy.ptosis = spread(0, 0.8, 2, 5);
  options.anatomy.pectoral_mm = spread(10, 25, 3, 4);
  options.scan.contrast = n % 2 ? Contrast::not_suppressed : Contrast::fat_suppressed;
  options.scan.noise = spread(0.03, 0.08, 1, 6);
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

SegmentInput input_of(const SyntheticPatient& patient, const std::filesystem::path& image) {
  SegmentInput input;
  input.mri = image;
  input.side = patient.truth.region.side;
  for (const Lesion& lesion : patient.truth.lesions) {
    LesionSeed& seed = input.lesions.emplace_back();
    seed.id = lesion.id;
    seed.point_in_lps = lesion.centroid_in_lps + Eigen::Vector3d(1.5, -1.5, 1.5);
  }
  return input;
}

nlohmann::json number(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

void write_scan(const std::filesystem::path& path, const Volume<std::int16_t>& scan) {
  auto image = scan.like<float>(0);
  std::copy(scan.values.begin(), scan.values.end(), image.values.begin());
  write_image(path, image);
}

/// A failed case stays in the table with its reason.
nlohmann::json evaluate(int n, const std::filesystem::path& image) {
  const PatientOptions options = options_of(n);
  nlohmann::json row = {{"name", "seed-" + std::to_string(options.anatomy.seed)},
                        {"contrast", name_of(options.scan.contrast)},
                        {"reason", nullptr}};
  for (const char* key :
       {"breast_dice", "fibroglandular_dice", "chest_wall_mean_mm", "skin_thickness_error_mm",
        "skin_surface_mean_mm", "nipple_mm", "lesion_dice", "lesion_centroid_mm"})
    row[key] = nullptr;
  try {
    const SyntheticPatient patient = make_possible(options);
    write_scan(image, patient.scan.image);
    const auto start = std::chrono::steady_clock::now();
    const SegmentResult result = segment(input_of(patient, image), {});
    row["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Segmentation truth = true_segmentation(patient.tissue, patient.labels, patient.truth);
    const SegmentationScore score = score_segmentation(truth, result.segmentation);
    row["status"] = to_string(result.quality.status);
    row["reasons"] = result.quality.reasons;
    row["found_contrast"] = result.quality.contrast;
    row["breast_dice"] = number(score.breast_dice);
    row["fibroglandular_dice"] = number(score.fibroglandular_dice);
    row["skin_thickness_mm"] = options.anatomy.skin_mm;
    row["skin_thickness_error_mm"] =
        std::abs(result.quality.skin_thickness_mm - options.anatomy.skin_mm);
    row["nipple_mm"] = score.nipple_mm;
    row["lesion_dice"] = number(score.lesion_dice);
    row["lesion_centroid_mm"] = number(score.lesion_centroid_mm);
    if (score.chest_wall) {
      row["chest_wall_mean_mm"] = score.chest_wall->mean;
      row["chest_wall_median_mm"] = score.chest_wall->median;
      row["chest_wall_p95_mm"] = score.chest_wall->p95;
    }
    if (score.skin_surface) row["skin_surface_mean_mm"] = score.skin_surface->mean;
  } catch (const std::exception& error) {
    row["status"] = "refused";
    row["reason"] = error.what();
  }
  return row;
}

int run(const Arguments& args) {
  std::filesystem::create_directories(args.table.parent_path());
  const std::filesystem::path image = args.table.parent_path() / "evaluated_mri.nrrd";
  nlohmann::json cases = nlohmann::json::array();
  for (int n = 0; n < args.synthetic; ++n) {
    cases.push_back(evaluate(n, image));
    std::cerr << cases.back().dump() << std::endl;
  }
  std::filesystem::remove(image);
  std::ofstream(args.table) << nlohmann::json{{"cases", cases}}.dump(1) << "\n";
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  CLI::App app{"segments synthetic patients whose truth is known and writes one table"};
  Arguments args;
  declare(app, args);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(args);
  } catch (const std::exception& error) {
    std::cerr << "evaluate-segmentation: " << error.what() << "\n";
    return 1;
  }
}
