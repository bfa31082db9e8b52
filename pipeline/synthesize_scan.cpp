// synthesize-scan: the laser scan of a mannequin-like gel breast.

#include "pipeline/synthesize/gel_breast.h"

#include <CLI/CLI.hpp>

#include <iostream>

int main(int argc, char** argv) {
  CLI::App app("Writes the simulated laser scan of a gel breast (noise 0.3 mm, holes, outliers)");
  std::filesystem::path scan;
  int seed = 1;
  app.add_option("scan", scan, "points to write (.ply)")->required();
  app.add_option("--seed", seed, "of the random numbers")->capture_default_str();
  try {
    app.parse(argc, argv);
    mammotwin::write_point_ply(scan, mammotwin::gel_breast_scan(seed));
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) ? 2 : 0;
  } catch (const std::exception& error) {
    std::cerr << "synthesize-scan: " << error.what() << std::endl;
    return 1;
  }
}
