#include "tests/pipeline/chain_run.h"

#include "tests/file_text.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Bytes = std::map<std::string, std::string>;

}  // namespace

std::vector<std::string> ChainRun::environment() const {
  return {"P=" + patient, "DATA=" + data.string(), "RESULTS=" + results.string(),
          "BIN=" MAMMOTWIN_BIN};
}

CommandResult ChainRun::run_script(const std::string& script, const std::string& target) const {
  std::vector<std::string> words{MAMMOTWIN_SOURCE_DIR "/pipeline/" + script};
  if (!target.empty()) words.push_back(target);
  return run_command(words, environment());
}

Bytes ChainRun::products() const {
  Bytes bytes;
  if (!fs::exists(results / patient)) return bytes;
  for (const auto& entry : fs::directory_iterator(results / patient))
    if (entry.is_regular_file() &&
        (entry.path().extension() != ".json" || entry.path().stem().extension() == ".mrk"))
      bytes[entry.path().filename().string()] = text_of(entry.path());
  return bytes;
}

}  // namespace mammotwin
