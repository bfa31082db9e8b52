// Seeds and inputs that once failed, through the readers as they are built for use: each is taken,
// or refused in words for a user.

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>

#include "tests/fuzz/readers/reader.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

struct Reader {
  const char* name;
  std::function<void(const std::string&)> read;
  bool takes_its_seeds = true;
};

void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What a user would be told; empty where it was read.
std::string refusal(const Reader& reader, const fs::path& file) {
  try {
    reader.read(bytes_of(file));
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) files.push_back(entry.path());
  return files;
}

class Corpus : public testing::TestWithParam<Reader> {};

TEST_P(Corpus, IsReadOrRefusedInWords) {
  const Reader& reader = GetParam();
  const fs::path folder = MAMMOTWIN_SOURCE_DIR "/tests/fuzz";
  const auto seeds = files_in(folder / "seeds" / reader.name);
  EXPECT_FALSE(seeds.empty());
  for (const fs::path& file : seeds) {
    const std::string said = refusal(reader, file);
    EXPECT_TRUE(said.empty() || !reader.takes_its_seeds) << file << ": " << said;
  }
  for (const fs::path& file : files_in(folder / "failed" / reader.name)) {
    const std::string said = refusal(reader, file);
    EXPECT_TRUE(said.empty() || is_said_to_a_user(said, bytes_of(file))) << file << ": " << said;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fuzz, Corpus,
    testing::Values(Reader{"nifti", fuzz::nifti}, Reader{"nrrd", fuzz::nrrd},
                    Reader{"meta_image", fuzz::meta_image}, Reader{"dicom_mri", fuzz::dicom_mri},
                    Reader{"segmentation", fuzz::segmentation}, Reader{"mesh", fuzz::mesh},
                    Reader{"surface", fuzz::surface},
                    Reader{"scan", fuzz::scan, false},  // a scan has a thousand points
                    Reader{"mammogram_dicom", fuzz::mammogram_dicom},
                    Reader{"mammogram_png", fuzz::mammogram_png},
                    Reader{"patient_toml", fuzz::patient_toml}, Reader{"markups", fuzz::markups},
                    Reader{"sidecar", fuzz::sidecar}, Reader{"checkpoint", fuzz::checkpoint},
                    Reader{"lesion_table", fuzz::lesion_table}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace mammotwin
