// read-mammogram on a DICOM file, alone and with what patient.toml says in place of findings.

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/registration/mammogram_dicom.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr int kColumns = 500, kRows = 700;

/// Half an ellipse of breast on the left edge and, brighter, a triangle of muscle.
std::vector<Uint16> drawn_mlo() {
  std::vector<Uint16> pixels(kColumns * kRows, 100);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      Uint16& grey = pixels[row * kColumns + column];
      if (std::hypot(column / 300.0, (row - 330) / 320.0) < 1) grey = 800;
      if (row < 100 && column < 260) grey = 800;
      if (column < 150 * (1 - row / 400.0)) grey = 1600;
    }
  return pixels;
}

class ReadMammogram : public ScratchFolder {
 protected:
  ReadMammogram() {
    DcmFileFormat file;
    DcmDataset& d = *file.getDataset();
    fill_mammogram(d);
    const std::vector<Uint16> pixels = drawn_mlo();
    d.putAndInsertString(DCM_ImagerPixelSpacing, "0.4\\0.4");
    d.putAndInsertUint16(DCM_Columns, kColumns);
    d.putAndInsertUint16(DCM_Rows, kRows);
    d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    file.saveFile(mammogram_.c_str(), EXS_LittleEndianExplicit);
  }

  json read(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{std::string(MAMMOTWIN_BIN) + "/mammotwin-read-mammogram",
                                       mammogram_.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = run_command(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.text;
    const auto begin = result.text.find('{'), end = result.text.rfind('}');
    if (begin == std::string::npos) return {};
    return json::parse(result.text.substr(begin, end - begin + 1));
  }
  json read_with(const std::string& toml) const {
    return read({"--patient", write("patient.toml", toml).string()});
  }

  std::filesystem::path mammogram_ = folder_ / "mlo.dcm";
};

TEST_F(ReadMammogram, SaysWhatAHeaderSaysAndItsPixelsShow) {
  const json said = read({"--picture", (folder_ / "seen.png").string()});
  EXPECT_EQ(said["view"], "mlo");
  EXPECT_EQ(said["side"], "left");
  EXPECT_EQ(said["pixel_mm"], 0.4);
  EXPECT_EQ(said["geometry"]["thickness_mm"], 57);
  EXPECT_EQ(said["findings"]["chest_wall"], "left");
  EXPECT_FALSE(said["findings"]["pectoral"].is_null());
  EXPECT_EQ(said.dump().find("SECRET"), std::string::npos);  // no name leaves the header
  EXPECT_TRUE(std::filesystem::exists(folder_ / "seen.png"));
}

TEST_F(ReadMammogram, TakesNippleAndMuscleFromThePatientsFile) {
  const json said = read_with(
      "[views.mlo]\nnipple_pixel = [280, 350]\npectoral = [[140, 0], [10, 380]]\n")["findings"];
  EXPECT_EQ(said["nipple"]["pixel"], json({280., 350.}));
  EXPECT_EQ(said["nipple"]["evidence"], "said");
  EXPECT_EQ(said["pectoral"]["line_pixels"], json({{140., 0.}, {10., 380.}}));
}

TEST_F(ReadMammogram, TakesTheSkinFromAContour) {
  write("skin.txt", "0 20\n200,100\n290 330\n200 560\n0 640\n");
  const json outline =
      read_with("[views.mlo]\noutline = \"skin.txt\"\n")["findings"]["outline_pixels"];
  ASSERT_EQ(outline.size(), 5u);
  EXPECT_NEAR(outline[2][0], 290, 1e-9);
  EXPECT_NEAR(outline[2][1], 330, 1e-9);
}

TEST_F(ReadMammogram, SaysWhichLineOfAContourIsNone) {
  write("skin.txt", "0 20\nhere\n");
  const CommandResult result =
      run_command({std::string(MAMMOTWIN_BIN) + "/mammotwin-read-mammogram", mammogram_.string(),
                   "--patient", write("patient.toml", "[views.mlo]\noutline = \"skin.txt\"\n")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.text.find("line \"here\""), std::string::npos) << result.text;
}

}  // namespace
}  // namespace mammotwin
