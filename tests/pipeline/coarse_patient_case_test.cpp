// A coarse patient whose headers, files and folders name a person, through the real stages: no
// output tells who it is, a run that is killed and begun again ends as an undisturbed one does, and
// after a change only the stages that it concerns run again.

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <zlib.h>

#include "registration/export/png_file.h"
#include "segmentation/segmentation_file.h"
#include "tests/pipeline/chain_run.h"
#include "tests/pipeline/killed_chain.h"
#include "tests/pipeline/opened_streams.h"
#include "tests/pipeline/patient_case.h"
#include "tests/pipeline/shown_rows.h"
#include "tests/registration/mammogram_dicom.h"
#include "tests/segmentation/files/dicom_writer.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// 042 at 60 % of its size, its voxels averaged to 2.2 x 1.4 x 2.2 mm: what a chain computes grows
/// with the breast's volume and with its voxels, and fit wants 20,000 of them.
const Eigen::Vector3i kCoarser(3, 2, 3);
constexpr double kScale = 0.6;

Volume<float> coarse(const Volume<float>& fine) {
  const Eigen::Vector3d coarser = kCoarser.cast<double>();
  const Eigen::Vector3i size = fine.size.cwiseQuotient(kCoarser);
  const Eigen::Vector3d shift = 0.5 * (coarser - Eigen::Vector3d::Ones());
  Volume<float> image(size, kScale * fine.spacing.cwiseProduct(coarser),
                      kScale * (fine.origin + shift.cwiseProduct(fine.spacing)));
  for (int k = 0; k < size.z() * kCoarser.z(); ++k)
    for (int j = 0; j < size.y() * kCoarser.y(); ++j)
      for (int i = 0; i < size.x() * kCoarser.x(); ++i)
        image(i / kCoarser.x(), j / kCoarser.y(), k / kCoarser.z()) +=
            fine(i, j, k) / kCoarser.prod();
  return image;
}

/// What names of files and folders, comments and private tags say, besides planted_identity.
std::vector<std::string> planted_words() {
  std::vector<std::string> words = planted_identity();
  for (const char* word :
       {"PLANTEDFOLDER", "PLANTEDDATA", "PLANTEDSLICE", "PLANTEDMLO", "PLANTEDCC", "PLANTEDMAP",
        "PLANTEDTEXT", "PLANTEDPRIVATE", "PLANTEDCOMMENT", "PLANTEDMEMBER"})
    words.push_back(word);
  return words;
}

/// Text attributes of images that the dictionary knows.
std::vector<DcmTagKey> text_attributes() {
  std::vector<DcmTagKey> tags;
  DcmDataDictionary& dictionary = dcmDataDict.wrlock();
  for (auto at = dictionary.normalBegin(); at != dictionary.normalEnd(); ++at) {
    const DcmEVR kind = (*at)->getEVR();
    const bool is_text = kind == EVR_LO || kind == EVR_SH || kind == EVR_ST || kind == EVR_LT ||
                         kind == EVR_UT || kind == EVR_PN || kind == EVR_UC;
    if (is_text && (*at)->getGroup() >= 0x0008 && (*at)->getGroup() <= 0x0040)
      tags.push_back((*at)->getKey());
  }
  dcmDataDict.wrunlock();
  return tags;
}

/// A word in every text attribute that the mammogram does not need, and in a private block.
void plant_text(DcmDataset& set) {
  for (const DcmTagKey& tag : text_attributes())
    if (!set.tagExistsWithValue(tag)) set.putAndInsertString(tag, "PLANTEDTEXT");
  set.putAndInsertString(DcmTag(0x0011, 0x0010, EVR_LO), "PLANTEDPRIVATE");
  set.putAndInsertString(DcmTag(0x0011, 0x1001, EVR_LO), "PLANTEDPRIVATE");
}

void write_dicom_mammogram(const fs::path& path) {
  DcmFileFormat mammogram;
  DcmDataset& set = *mammogram.getDataset();
  fill_mammogram(set);
  set.putAndInsertString(DCM_PatientID, "PLANTED-ID-4711");
  set.putAndInsertString(DCM_StudyDate, "20010405");
  set.putAndInsertString(DCM_StudyInstanceUID, "1.2.840.99.77.1.4711");
  set.putAndInsertString(DCM_AccessionNumber, "PLANTED-ACCESSION");
  set.putAndInsertString(DCM_StudyID, "PLANTED-STUDY");
  set.putAndInsertString(DCM_ReferringPhysicianName, "PHYSICIAN^PLANTED");
  plant_text(set);
  ASSERT_TRUE(mammogram.saveFile(path.c_str(), EXS_LittleEndianExplicit).good());
}

std::string big_endian(std::uint32_t number) {
  return {char(number >> 24), char(number >> 16), char(number >> 8), char(number)};
}

/// A PNG with a comment (PNG specification, 11.3.4.3) before its last chunk.
void write_png_mammogram(const fs::path& path) {
  write_png(path, GreyPixels{40, 60, std::vector<std::uint16_t>(40 * 60, 900)});
  std::ifstream in(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  const std::string body = std::string("tEXtComment") + '\0' + "PLANTEDCOMMENT";
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  bytes.insert(bytes.size() - 12, big_endian(body.size() - 4) + body + big_endian(sum));
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The lesion as a label map in NIfTI, packed by a gzip that keeps the name of what it packs.
void write_lesion_map(const fs::path& path, const Volume<float>& image) {
  const Eigen::Vector3d place(35.9, -14.5, -8.4);
  std::string h(352, '\0');  // bytes of the fields by the NIfTI-1 standard
  const auto put = [&](std::size_t at, auto value) { std::memcpy(&h[at], &value, sizeof value); };
  put(0, std::int32_t{348});
  put(40, std::int16_t{3});
  for (int a = 0; a < 3; ++a) put(42 + 2 * a, static_cast<std::int16_t>(image.size[a]));
  put(70, std::int16_t{2});  // unsigned char
  put(72, std::int16_t{8});
  put(76, 1.0f);
  for (int a = 0; a < 3; ++a) put(80 + 4 * a, static_cast<float>(image.spacing[a]));
  put(108, 352.0f);
  h.replace(148, 11, "PLANTEDTEXT");  // descrip
  put(254, std::int16_t{1});
  for (int a = 0; a < 3; ++a) {  // x and y run the other way than in LPS
    put(280 + 20 * a, static_cast<float>(a < 2 ? -image.spacing[a] : image.spacing[a]));
    put(292 + 16 * a, static_cast<float>(a < 2 ? -image.origin[a] : image.origin[a]));
  }
  put(344, std::array<char, 4>{'n', '+', '1', 0});
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        h += static_cast<char>((image.position(i, j, k) - place).norm() < 4.8);
  z_stream z{};
  deflateInit2(&z, 1, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY);
  gz_header names{};
  std::string name = "PLANTEDMEMBER", comment = "PLANTEDCOMMENT";
  names.name = reinterpret_cast<Bytef*>(name.data());
  names.comment = reinterpret_cast<Bytef*>(comment.data());
  deflateSetHeader(&z, &names);
  std::string packed(deflateBound(&z, h.size()) + 200, '\0');
  z.next_in = reinterpret_cast<Bytef*>(h.data());
  z.avail_in = static_cast<uInt>(h.size());
  z.next_out = reinterpret_cast<Bytef*>(packed.data());
  z.avail_out = static_cast<uInt>(packed.size());
  deflate(&z, Z_FINISH);
  packed.resize(z.total_out);
  deflateEnd(&z);
  std::ofstream(path, std::ios::binary) << packed;
}

class CoarsePatient : public PatientCase {
 protected:
  void SetUp() override {
    fs::create_directories(patient_folder());
    say("");
    DicomHeader header;
    header.identified = true;
    const Volume<float> image =
        coarse(read_image_file(MAMMOTWIN_SOURCE_DIR "/sample_data/042/mri.nrrd"));
    write_dicom_series(patient_folder() / "PLANTEDFOLDER", "PLANTEDSLICE", header, image);
    write_lesion_map(patient_folder() / "PLANTEDMAP.nii.gz", image);
    write_png_mammogram(patient_folder() / "PLANTEDCC.png");
    write_dicom_mammogram(patient_folder() / "PLANTEDMLO.dcm");
  }
  /// Light compression of few elements, and no search: the chain is short, its stages are all
  /// there.
  void say(const std::string& more) const {
    std::ofstream(patient_folder() / "patient.toml") << R"(side = "left"
materials.preset = "neo_hookean_2026"
register.search = false
fit.elements = [4, 4, 1]
)" << more << R"(
[mri]
path = "PLANTEDFOLDER"
[[lesions]]
labels = "PLANTEDMAP.nii.gz"
[views.cc]
mammogram = "PLANTEDCC.png"
thickness_mm = 48
detector.pixel_spacing_mm = 2
detector.columns = 40
detector.rows = 60
[views.mlo]
mammogram = "PLANTEDMLO.dcm"
thickness_mm = 45
)";
  }
  fs::path data_folder() const { return folder_ / "PLANTEDDATA"; }
  fs::path patient_folder() const { return data_folder() / "c"; }
  ChainRun chain() const { return {"c", data_folder(), results()}; }
  void expect_nobody_named(const std::string& when);
  void expect_cut_mammograms_refused() const;
  void expect_another_angle_to_keep_what_it_does_not_change() const;
};

void CoarsePatient::expect_another_angle_to_keep_what_it_does_not_change() const {
  const auto before = times_of_change("c");
  std::ofstream(patient_folder() / "patient.toml", std::ios::app) << "angle_deg = 50\n";
  const CommandResult result = chain().run_script("run_patient.sh", "patient");
  ASSERT_EQ(result.exit_code, 0) << result.text;
  const auto after = times_of_change("c");
  for (const char* kept : {"segmentation.seg.nrrd", "fractions.nrrd", "mri.nrrd", "prone.vtu",
                           "prone.exf", "unloaded.vtu", "cc.vtu"})
    EXPECT_EQ(after.at(kept), before.at(kept)) << kept;
  for (const char* made_again : {"mlo.vtu", "lesions.csv", "report.html"})
    EXPECT_NE(after.at(made_again), before.at(made_again)) << made_again;
}

/// A picture that is registered with, a DICOM file whose header is whole and is compressed with:
/// both without a search, which would read them.
void CoarsePatient::expect_cut_mammograms_refused() const {
  const fs::path picture = patient_folder() / "PLANTEDCC.png",
                 dicom = patient_folder() / "PLANTEDMLO.dcm";
  fs::resize_file(picture, 93);
  const CommandResult registered = chain().run_script("run_patient.sh", "register");
  EXPECT_EQ(registered.exit_code, 1) << registered.text;
  EXPECT_NE(registered.text.find("register: refused: the cc mammogram"), std::string::npos)
      << registered.text;
  write_png_mammogram(picture);
  fs::resize_file(dicom, fs::file_size(dicom) - 1000);
  const CommandResult compressed = chain().run_script("run_patient.sh", "compress");
  EXPECT_EQ(compressed.exit_code, 1) << compressed.text;
  EXPECT_NE(compressed.text.find("compress: refused: the mlo mammogram"), std::string::npos)
      << compressed.text;
}

/// What dicom_export asks for: objects that hang in the patient's study.
bool may_say(const fs::path& file, const std::string& word) {
  const std::vector<std::string> shared{
      "SECRET",        "PLANTED-ACCESSION", "PLANTED-ID-4711", "20010405", "1.2.840.99.77.1.4711",
      "PLANTED-STUDY", "PHYSICIAN^PLANTED", "19510203"};
  return file.parent_path().filename() == "dicom" &&
         std::find(shared.begin(), shared.end(), word) != shared.end();
}

/// What was opened of a product to look for planted words, and in how many of its texts one stood.
nlohmann::json opened_row(const std::string& when, const std::string& name,
                          const OpenedStreams& streams, int told, int allowed) {
  std::size_t bytes = 0;
  for (const std::string& text : streams.texts) bytes += text.size();
  nlohmann::json row{{"export", when},
                     {"file", name},
                     {"searched_mb", static_cast<double>(bytes) / 1e6},
                     {"told", told},
                     {"allowed", allowed}};
  for (const char* kind : {"gzip", "zlib", "base64"})
    row[kind] = streams.opened.count(kind) ? streams.opened.at(kind) : 0;
  return row;
}

void CoarsePatient::expect_nobody_named(const std::string& when) {
  std::map<std::string, int> opened;
  nlohmann::json rows = nlohmann::json::array();
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(results())) {
    const fs::path& path = entry.path();
    if (!entry.is_regular_file() || path.parent_path().filename() == "logs") continue;
    const std::string name = path.lexically_relative(results()).string();
    const OpenedStreams streams = opened_streams(text_of(path));
    int told = 0, allowed = 0;
    for (const std::string& word : planted_words()) {
      told += name.find(word) != std::string::npos;
      for (const std::string& text : streams.texts) {
        if (text.find(word) == std::string::npos) continue;
        may_say(path, word) ? ++allowed : ++told;
        EXPECT_TRUE(may_say(path, word))
            << path << " tells " << word << ": "
            << text.substr(std::max<std::size_t>(60, text.find(word)) - 60, 140);
      }
    }
    EXPECT_EQ(told, 0) << path;
    rows.push_back(opened_row(when, name, streams, told, allowed));
    for (const auto& [kind, count] : streams.opened) opened[kind] += count;
    ++files;
  }
  std::sort(rows.begin(), rows.end(), [](const nlohmann::json& a, const nlohmann::json& b) {
    return a.at("file") < b.at("file");
  });
  show_rows("opened", "export", rows);
  EXPECT_GT(files, 35);  // products, sidecars, page, scene, tables
  std::cerr << when << ": searched " << files << " files, opened";
  for (const auto& [kind, count] : opened) std::cerr << " " << count << " " << kind;
  std::cerr << "\n";
  EXPECT_GT(opened["gzip"], 3);
  EXPECT_GT(opened["zlib"], 20);
  EXPECT_GT(opened["base64"], 20);
}

// The search finds what is there: the inputs themselves name the patient.
TEST_F(CoarsePatient, IsNamedByItsInputs) {
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(data_folder())) {
    all += entry.path().string();
    if (entry.is_regular_file()) all += text_of(entry.path());
  }
  for (const std::string& word : planted_words())
    EXPECT_NE(all.find(word), std::string::npos) << word;
}

TEST_F(CoarsePatient, IsNamedNowhereAndLosesNothingToKills) {
  const CommandResult run = chain().run_script("cohort/run_cohort.sh");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const auto expected = chain().products();
  ASSERT_TRUE(expected.count("lesions.csv") && expected.count("report.html"));
  EXPECT_NE(expected.at("report.html").find("own L-MLO with the predicted places"),
            std::string::npos);
  const CommandResult scene = chain().run_script("run_patient.sh", "slicer");
  EXPECT_EQ(scene.exit_code, 0) << scene.text;
  expect_nobody_named("without dicom_export");

  const char *at_moments = std::getenv("MAMMOTWIN_KILLS"),
             *at_steps = std::getenv("MAMMOTWIN_STEP_KILLS");
  if (at_moments || at_steps) {
    KilledChain killed(chain(), folder_ / "layer", at_moments ? "coarse" : "coarse, at steps");
    if (at_steps) killed.kill_at_steps(std::atol(at_steps));
    if (at_moments) killed.kill_at_moments(per_stage(std::atoi(at_moments)));
  }

  expect_another_angle_to_keep_what_it_does_not_change();
  say("dicom_export = true\n");
  const CommandResult exported = chain().run_script("run_patient.sh", "slicer");
  EXPECT_EQ(exported.exit_code, 0) << exported.text;
  EXPECT_TRUE(fs::exists(results() / "c" / "dicom" / "mlo_gsps.dcm"));
  expect_nobody_named("with dicom_export");
  expect_cut_mammograms_refused();
}

// A refusal names the file on the terminal and not in what is left.
TEST_F(CoarsePatient, IsNotNamedByARefusal) {
  std::ofstream(patient_folder() / "PLANTEDFOLDER" / "PLANTEDSLICE0003.dcm", std::ios::app) << "x";
  fs::resize_file(patient_folder() / "PLANTEDFOLDER" / "PLANTEDSLICE0003.dcm", 2000);
  const CommandResult run = chain().run_script("run_patient.sh", "patient");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.text.find("PLANTEDSLICE0003.dcm"), std::string::npos) << run.text;
  for (const auto& entry : fs::recursive_directory_iterator(results()))
    if (entry.is_regular_file()) {
      for (const std::string& text : opened_streams(text_of(entry.path())).texts)
        EXPECT_EQ(text.find("PLANTED"), std::string::npos)
            << entry.path()
            << text.substr(std::max<std::size_t>(60, text.find("PLANTED")) - 60, 140);
    }
}

}  // namespace
}  // namespace mammotwin
