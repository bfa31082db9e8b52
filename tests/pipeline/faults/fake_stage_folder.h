#pragma once

#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {

/// A stage of the real frame without mathematics, that writes a product of 256 KiB and one beside
/// it (cohort_fake_stage).
class FakeStageFolder : public ScratchFolder {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "bin");
    std::filesystem::create_symlink(MAMMOTWIN_BIN "/cohort_fake_stage",
                                    folder_ / "bin" / "mammotwin-fit");
    std::filesystem::create_directories(folder_ / "data" / "mri");
    std::filesystem::create_directories(folder_ / "disk");
    write("data/mri/0.dcm", "an image");
    behave("");
    write("data/patient.toml", "mri.path = \"mri\"\n");
    for (const char* input : {"a", "b"}) write(input, input);
  }
  void behave(const std::string& how) const { write("data/behaviour.txt", how + "\n"); }
  std::vector<std::string> stage() const {
    return {(folder_ / "bin" / "mammotwin-fit").string(),
            (folder_ / "a").string(),
            (folder_ / "b").string(),
            product().string(),
            "--patient",
            (folder_ / "data" / "patient.toml").string()};
  }
  std::filesystem::path product() const { return folder_ / "disk" / "new" / "p" / "prone.vtu"; }
  std::string products() const {
    return text_of(product()) + text_of(product().parent_path() / "prone.exf");
  }
  /// Hidden files and folders beside the product: partial ones, locks.
  std::vector<std::string> hidden() const {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(product().parent_path(), none))
      if (const std::string name = entry.path().filename().string(); name.front() == '.')
        names.push_back(name);
    return names;
  }
};

}  // namespace mammotwin
