#pragma once

#include "pipeline/frame/process.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <string>

namespace mammotwin {

/// `main` of a command that is not a stage: declares its arguments, parses, runs. Exit code 2 where
/// the command line is wrong, 1 where `run` throws, else what `run` returns.
template <class Arguments, class Declare, class Run>
int run_plain_command(int argc, char** argv, const std::string& name, const std::string& about,
                   Declare declare, Run run) {
  prepare_process(argv);
  CLI::App app(about);
  Arguments args;
  declare(app, args);
  try {
    app.parse(argc, argv);
    return run(args);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) ? 2 : 0;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << std::endl;
    return 1;
  }
}

}  // namespace mammotwin
