// validate: the paper's gel cylinder, squeezed in four ways, against other codes ->
// validation.json, pictures.

#include <iostream>
#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/frame/products.h"
#include "pipeline/validation/claims.h"
#include "pipeline/validation/gel_figures.h"
#include "pipeline/validation/gel_table.h"

namespace mammotwin {
namespace {

struct Arguments {
  std::filesystem::path cases, result;
  bool claims = true;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("cases", args.cases, "folder with lateral.toml, plane_strain.toml, ...")
      .required()
      .existing_folder();
  command.option("result", args.result, "validation.json to write; pictures go beside it")
      .required();
  command.flag("!--no-claims", args.claims,
               "leave out the tables of elements and penalties (a minute)");
}

constexpr const char* kCases[] = {"lateral", "plane_strain", "axial", "bonded"};
constexpr double kPixelsPerPoint = 2;

void write_pictures(const GelResult& r, Products& products) {
  const std::string& name = r.experiment.name;
  if (r.study.size() > 1)
    convergence_picture(r).write_png(products.write(name + "_convergence.png"), kPixelsPerPoint);
  if (r.curve.size() > 1)
    curve_picture(r).write_png(products.write(name + "_curve.png"), kPixelsPerPoint);
  if (r.experiment.experiment.how == CylinderCase::lateral)
    outline_picture(r).write_png(products.write("outlines.png"), kPixelsPerPoint);
}

void say(const std::string& text) { std::cerr << text << std::endl; }

/// The paper's claims about elements and penalties, on its own experiment -> claims.json.
void check_claims(const GelCase& lateral, Products& products) {
  const double force_N = lateral.force_N.value();
  const auto elements = compare_elements(lateral.experiment, say);
  std::cout << element_table(elements, force_N) << std::endl;
  const auto penalties = compare_penalties(lateral.experiment, say);
  std::cout << penalty_table(penalties, force_N) << std::endl;
  const nlohmann::json document = {{"elements", to_json(elements, force_N)},
                                   {"penalties", to_json(penalties, force_N)}};
  write_text_atomically(products.write("claims.json"), document.dump(1) + "\n");
}

int run(const Arguments& args) {
  Products products(args.result);
  nlohmann::json document = nlohmann::json::object();
  std::vector<std::string> missed;
  for (const std::string name : kCases) {
    const GelCase experiment = read_gel_case(args.cases / (name + ".toml"));
    const GelResult result = run_gel_case(experiment, say);
    document[name] = to_json(result);
    for (const nlohmann::json& row : mesh_rows(result)) document["cases"].push_back(row);
    std::cout << gel_table(result) << std::endl;
    write_pictures(result, products);
    for (const std::string& sentence : missed_targets(result)) missed.push_back(sentence);
    if (name == "lateral" && args.claims) check_claims(experiment, products);
  }
  write_text_atomically(products.write_main(), document.dump(1) + "\n");
  products.commit();
  for (const std::string& sentence : missed) std::cerr << "missed: " << sentence << "\n";
  return missed.empty() ? 0 : 3;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(
      argc, argv, "validate",
      "Squeezes the paper's gel cylinder in four ways and compares with other codes", declare, run);
}
