// A stage without mathematics inside the real frame: by the name that it is called by (a link
// "mammotwin-fit") it reads its inputs and writes products whose bytes follow from them. A file
// behaviour.txt beside patient.toml makes it fail: "refuse fit", "diverge compress",
// "diverge compress cc" (one view), "die fit", "look fit", "slow fit", "linger fit" (between its
// products), "short fit" (only its main product), a line each.

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/stage.h"
#include "pipeline/patient/patient.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<fs::path> inputs{4};
  std::string view;
  fs::path product;
};

/// The positional files of run_patient.sh: how many inputs, and what is written beside the product.
struct Shape {
  std::size_t num_inputs;
  std::vector<std::string> side_products;
};
const std::map<std::string, Shape> kShapes{{"segment", {0, {"fractions.nrrd", "mri.nrrd"}}},
                                           {"fit", {2, {"prone.exf"}}},
                                           {"unload", {3, {}}},
                                           {"compress", {3, {}}},
                                           {"register", {4, {"lesions_prone.mrk.json"}}},
                                           {"report", {0, {}}}};

fs::path mri_of(const Patient& patient) { return patient.segment_files().at(0); }

std::set<std::string> behaviours(const Patient& patient) {
  std::ifstream in(mri_of(patient).parent_path() / "behaviour.txt");
  std::set<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.insert(line);
  return lines;
}

constexpr int kProductBlocks = 4000;  // of 64 bytes: 256 KiB, so that writing takes some time

void write_product(const fs::path& path, std::string hash) {
  std::ofstream out(path, std::ios::binary);
  for (int i = 0; i < kProductBlocks; ++i) out << (i % 100 ? hash : hash = sha256_of_text(hash));
  out.close();
  if (!out)
    throw std::runtime_error(path.filename().string() + ": cannot be written (is the disk full?)");
}

nlohmann::json fake_quality(const std::string& hash) {
  const double figure = std::stoi(hash.substr(0, 4), nullptr, 16) / 65536.0;
  return {{"figure_mm", figure},
          {"elements", {6, 6, 2}},
          {"side", "left"},
          {"missing", nullptr},
          {"history", {1, 2, 3, 4, 5}},
          {"lesions", {{{"id", "a"}, {"volume_ml", 2 * figure}}}}};
}

Outcome run_fake(const std::string& name, const Shape& shape, const Arguments& args,
                 const Patient& patient, StageRun& run) {
  const auto asked = behaviours(patient);
  const auto is_asked = [&](const std::string& what) {
    const std::string stage = what + " " + name;
    return asked.contains(stage) || asked.contains(stage + " " + args.view);
  };
  if (is_asked("die")) raise(SIGKILL);
  if (is_asked("slow")) std::this_thread::sleep_for(std::chrono::seconds(2));
  if (is_asked("refuse")) return {Status::refused, {"the breast is a <cube>"}, {}};
  if (is_asked("diverge"))
    return {
        Status::not_converged, {"the last good thickness is 61.2 mm"}, {{"thickness_mm", 61.2}}};
  std::string text = name + args.view + sha256_of_path(mri_of(patient));
  for (std::size_t i = 0; i < shape.num_inputs; ++i)
    if (fs::exists(args.inputs[i])) text += sha256_of_path(args.inputs[i]);
  const std::string hash = sha256_of_text(text);
  write_product(run.products.write_main(), hash);
  if (is_asked("linger")) std::this_thread::sleep_for(std::chrono::seconds(3));
  for (const std::string& side :
       is_asked("short") ? std::vector<std::string>{} : shape.side_products)
    write_product(run.products.write(side), sha256_of_text(hash + side));
  if (is_asked("look")) return {Status::look, {"the skin is thin"}, fake_quality(hash)};
  return {Status::ok, {}, fake_quality(hash)};
}

Stage fake_stage(const std::string& name, const Patient& patient, Arguments& args) {
  const Shape& shape = kShapes.at(name);
  Stage stage;
  stage.name = name;
  stage.summary = "a stage without mathematics";
  stage.declare = [&, name](StageDeclaration& declaration) {
    if (name == "compress")
      declaration.command().option("view", args.view, "which view").required();
    if (name == "report")
      declaration.command().option("folder", args.view, "of results").required();
    constexpr std::size_t first_view = 2;  // of what register reads
    for (std::size_t i = 0; i < shape.num_inputs; ++i) {
      const std::string input = "input" + std::to_string(i);
      if (name == "register" && i >= first_view)
        declaration.input_or_failure(input, args.inputs[i], "");
      else
        declaration.input(input, args.inputs[i], "");
    }
    declaration.product("product", args.product, "");
  };
  stage.plan = [&] {
    return StagePlan{{mri_of(patient), mri_of(patient).parent_path() / "behaviour.txt"}, {}};
  };
  stage.run = [&, name](StageRun& run) { return run_fake(name, shape, args, patient, run); };
  return stage;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  const std::string called = std::filesystem::path(argv[0]).filename().string();
  mammotwin::Arguments args;
  mammotwin::Patient patient;
  return mammotwin::run_stage(
      argc, argv, patient,
      mammotwin::fake_stage(called.substr(std::string("mammotwin-").size()), patient, args));
}
