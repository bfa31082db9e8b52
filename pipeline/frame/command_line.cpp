#include "pipeline/frame/command_line.h"

#include <CLI/CLI.hpp>

namespace mammotwin {

namespace fs = std::filesystem;

Argument Argument::required() {
  option_->required();
  return *this;
}

Argument Argument::existing_file() {
  option_->check(CLI::ExistingFile);
  return *this;
}

Argument Argument::existing_folder() {
  option_->check(CLI::ExistingDirectory);
  return *this;
}

Argument Argument::between(int low, int high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

Argument Argument::between(double low, double high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

Argument Argument::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

Argument Argument::values(int count) {
  option_->expected(count);
  return *this;
}

Argument Argument::with_default() {
  option_->capture_default_str();
  return *this;
}

Argument Argument::described_as(const std::string& type, const std::string& default_value) {
  option_->type_name(type)->default_str(default_value);
  return *this;
}

CommandLine::CommandLine(const std::string& about) : app_(std::make_unique<CLI::App>(about)) {
  app_->set_version_flag("--version", std::string(MAMMOTWIN_VERSION));
  app_->get_formatter()->column_width(44);
}

CommandLine::~CommandLine() = default;

template <class T>
Argument CommandLine::option(const std::string& name, T& variable, const std::string& help) {
  return Argument(app_->add_option(name, variable, help));
}

template Argument CommandLine::option(const std::string&, fs::path&, const std::string&);
template Argument CommandLine::option(const std::string&, std::optional<fs::path>&,
                                      const std::string&);
template Argument CommandLine::option(const std::string&, std::string&, const std::string&);
template Argument CommandLine::option(const std::string&, int&, const std::string&);
template Argument CommandLine::option(const std::string&, double&, const std::string&);
template Argument CommandLine::option(const std::string&, std::vector<int>&, const std::string&);
template Argument CommandLine::option(const std::string&, std::vector<double>&, const std::string&);
template Argument CommandLine::option(const std::string&, std::vector<std::string>&,
                                      const std::string&);

void CommandLine::flag(const std::string& name, bool& variable, const std::string& help) {
  app_->add_flag(name, variable, help);
}

void CommandLine::text_flag(const std::string& name, std::function<std::string()> text,
                            const std::string& help) {
  app_->add_flag_callback(
      name,
      [text = std::move(text)] {
        std::cout << text();
        throw CLI::Success();
      },
      help);
}

bool CommandLine::has(const std::string& name) const { return app_->count(name) > 0; }

std::optional<int> CommandLine::parse(int argc, char** argv) {
  constexpr int bad_usage = 2;
  try {
    app_->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? 0 : bad_usage;
  }
}

}  // namespace mammotwin
