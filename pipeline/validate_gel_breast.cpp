// validate-gel-breast: a breast of gel, scanned, fitted and squeezed, against its true skin ->
// validation.json, a picture.

#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "pipeline/validation/fit_convergence.h"
#include "pipeline/validation/gel_breast_picture.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path scan, result;
  GelBreastMeshes meshes;
  std::vector<double> fractions = {0.25, 0.5};
  std::vector<int> columns = {4, 5, 6, 8, 10, 12};
};

void declare(CommandLine& command, Arguments& args) {
  command.option("scan", args.scan, "scan of the gel breast (.ply)").required().existing_file();
  command.option("result", args.result, "validation.json to write; gel_breast.png goes beside it")
      .required();
  command
      .option("--model-columns", args.meshes.model[0],
              "of the model's mesh, along x and z [4 to 16]")
      .between(4, 16)
      .with_default();
  command
      .option("--true-columns", args.meshes.truth[0],
              "of the true breast's mesh, the same [4 to 16]")
      .between(4, 16)
      .with_default();
  command
      .option("--columns", args.columns,
              "of the meshes whose accuracy is compared, along x and z [1 to 16]")
      .between(1, 16)
      .with_default();
  command
      .option("--fractions", args.fractions,
              "of the free extent that is taken away, each [0.05 to 0.7]")
      .between(0.05, 0.7)
      .with_default();
}

constexpr double kPixelsPerPoint = 2;

void say(const std::string& text) { std::cerr << text << std::endl; }

/// Accuracy of the fit against its element count -> fit_convergence.png.
void check_convergence(const Arguments& args, Products& products, nlohmann::json& document) {
  const std::vector<FitAccuracy> accuracies = fit_convergence(args.scan, args.columns, say);
  document["fit_convergence"] = to_json(accuracies);
  if (accuracies.size() > 1)
    fit_convergence_picture(accuracies)
        .write_png(products.write("fit_convergence.png"), kPixelsPerPoint);
}

int run(Arguments args) {
  for (Eigen::Vector3i* elements : {&args.meshes.model, &args.meshes.truth})
    elements->y() = elements->x();
  const GelBreastResult result = run_gel_breast(args.scan, args.meshes, args.fractions, say);
  Products products(args.result);
  nlohmann::json document = to_json(result);
  if (!args.columns.empty()) check_convergence(args, products, document);
  std::cout << document.dump(1) << std::endl;
  write_text_atomically(products.write_main(), document.dump(1) + "\n");
  if (!result.states.empty())
    gel_breast_picture(result).write_png(products.write("gel_breast.png"), kPixelsPerPoint);
  products.commit();
  const std::vector<std::string> missed = missed_targets(result);
  for (const std::string& sentence : missed) std::cerr << "missed: " << sentence << "\n";
  return missed.empty() ? 0 : 3;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "validate-gel-breast",
      "Squeezes a scanned breast of gel and compares with its true skin on a finer mesh", declare,
      run);
}
