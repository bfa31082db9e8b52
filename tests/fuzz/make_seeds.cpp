// fuzz_seeds FOLDER: a few small whole files for each reader, from which fuzzing begins.

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>

#include "fitting/mesh/block_mesh.h"
#include "fitting/mesh/mesh_file.h"
#include "pipeline/frame/sidecar.h"
#include "pipeline/frame/sidecar_check.h"
#include "registration/export/lesion_table.h"
#include "registration/export/markups.h"
#include "registration/export/png_file.h"
#include "segmentation/segmentation_file.h"
#include "solver/press/checkpoint.h"
#include "tests/registration/mammogram_dicom.h"
#include "tests/segmentation/files/dicom_writer.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}
  fs::path at(const std::string& reader, const std::string& name) const {
    fs::create_directories(folder_ / reader);
    return folder_ / reader / name;
  }
  void text(const std::string& reader, const std::string& name, const std::string& bytes) const {
    std::ofstream(at(reader, name), std::ios::binary) << bytes;
  }

 private:
  fs::path folder_;
};

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size()};
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// 6 x 5 x 4 voxels of 2 mm, no two planes alike.
std::vector<std::int16_t> voxels() {
  std::vector<std::int16_t> values;
  for (int n = 0; n < 6 * 5 * 4; ++n) values.push_back(static_cast<std::int16_t>(7 * n % 90));
  return values;
}

/// Bytes of the fields by the NIfTI-1 standard.
std::string nifti() {
  std::string h(352, '\0');
  put<std::int32_t>(h, 0, 348);
  const std::int16_t dim[] = {3, 6, 5, 4, 1, 1, 1, 1};
  std::memcpy(h.data() + 40, dim, sizeof dim);
  put<std::int16_t>(h, 70, 4);  // int16
  put<std::int16_t>(h, 72, 16);
  for (int n = 0; n < 8; ++n) put<float>(h, 76 + 4 * n, n == 0 ? 1.0f : 2.0f);
  put<float>(h, 108, 352);
  put<std::int16_t>(h, 254, 1);
  for (int row = 0; row < 3; ++row) put<float>(h, 280 + 16 * row + 4 * row, 2);
  std::memcpy(h.data() + 344, "n+1", 4);
  return h + bytes_of(voxels());
}

std::string nrrd(const std::string& kind, const std::string& step_mm) {
  return "NRRD0004\n# made by hand\ntype: " + kind +
         "\ndimension: 3\nspace: left-posterior-superior\nsizes: 6 5 4\nspace directions: (" +
         step_mm + ",0,0) (0," + step_mm + ",0) (0,0," + step_mm +
         ")\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n\n";
}

std::string meta_image() {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = "
         "False\nCompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 "
         "0\nCenterOfRotation = 0 0 0\nElementSpacing = 2 2 2\nDimSize = 6 5 4\nElementType = "
         "MET_SHORT\nElementDataFile = LOCAL\n" +
         bytes_of(voxels());
}

void write_images(const Seeds& seeds) {
  seeds.text("nifti", "whole.nii", nifti());
  seeds.text("nrrd", "whole.nrrd", nrrd("int16", "2") + bytes_of(voxels()));
  seeds.text("meta_image", "whole.mha", meta_image());
  std::vector<std::uint16_t> slice(64, 100);
  slice[9] = 700;
  seeds.text("dicom_mri", "slice.dcm",
             dicom_slice_bytes(DicomHeader(), 3, 8, 8, {0, 0, 6}, 2, slice));
  DicomHeader dynamic;
  dynamic.temporal_position = "2", dynamic.acquisition_time = "120000";
  seeds.text("dicom_mri", "phase.dcm", dicom_slice_bytes(dynamic, 3, 8, 8, {0, 0, 6}, 2, slice));
}

/// Voxels of 8 mm: a breast is at least 15 mm deep.
void write_segmentations(const Seeds& seeds) {
  Segmentation s;
  s.labels = Volume<std::uint8_t>({6, 5, 4}, {8, 8, 8}, {0, 0, 0}, label::fat);
  for (int j = 3; j < 5; ++j)
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 6; ++i) s.labels(i, j, k) = j == 3 ? label::muscle : label::skin;
  s.labels(2, 2, 2) = label::lesion;
  s.region = {Side::left, 0, 40, 0, 24};
  s.lesions = {{"L1", {16, 16, 16}, 0.512}};
  write_segmentation(seeds.at("segmentation", "whole.seg.nrrd"), s);
  std::string labels(s.labels.values.begin(), s.labels.values.end());
  seeds.text("segmentation", "edited.seg.nrrd", nrrd("uint8", "8") + labels);
}

void write_meshes(const Seeds& seeds) {
  MeshFile file{block_mesh({0, 0, 0}, {40, 30, 20}, {1, 1, 1}), {}, {}, {}, {}, {}};
  file.faces.resize(file.mesh.num_elements());
  file.ties = {{0, 1, 1, 1, 1.0}};
  file.configurations["prone"] = file.mesh.nodes();
  file.metadata["view_angle_deg"] = {45};
  write_mesh_file(seeds.at("mesh", "whole.vtu"), file);
}

std::string off_block() {
  return "OFF\n8 6 0\n0 0 0\n40 0 0\n40 30 0\n0 30 0\n0 0 20\n40 0 20\n40 30 20\n0 30 20\n"
         "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n4 1 2 6 5\n4 0 4 7 3\n";
}

std::string binary_stl() {
  std::string bytes(80, ' ');
  bytes += std::string("\1\0\0\0", 4);
  return bytes + bytes_of(std::vector<float>{0, 0, 1, 0, 0, 0, 40, 0, 0, 0, 30, 0}) +
         std::string(2, '\0');
}

void write_surfaces(const Seeds& seeds) {
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 40 0 0\nvertex 0 30 "
      "0\nendloop\nendfacet\nendsolid a\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n40 0 0\n0 30 "
      "0\n3 0 1 2\n";
  const std::string obj = "v 0 0 0\nv 40 0 0\nv 0 30 0\nf 1 2 3\n";
  for (const char* reader : {"surface", "scan"}) {
    seeds.text(reader, "text.stl", stl);
    seeds.text(reader, "whole.ply", ply);
    seeds.text(reader, "whole.obj", obj);
    seeds.text(reader, "whole.off", off_block());
    seeds.text(reader, "commented.off", "# a block\n" + off_block());
  }
  seeds.text("surface", "binary.stl", binary_stl());
  seeds.text("scan", "whole.xyz", "0 0 0\n40 0 0\n0 30 0\n20 15 60\n");
}

void write_mammograms(const Seeds& seeds) {
  for (const auto& [name, syntax] : {std::pair("plain.dcm", EXS_LittleEndianExplicit),
                                     std::pair("big.dcm", EXS_BigEndianExplicit),
                                     std::pair("implicit.dcm", EXS_LittleEndianImplicit)}) {
    DcmFileFormat file;
    fill_mammogram(*file.getDataset());
    file.saveFile(seeds.at("mammogram_dicom", name).c_str(), syntax);
  }
  GreyPixels grey{12, 9, std::vector<std::uint16_t>(12 * 9, 500)};
  grey.grey[40] = 40000;
  write_png(seeds.at("mammogram_png", "whole.png"), grey);
}

const char kToml[] = R"(side = "left"
privacy.keep_names = false
[mri]
path = "mri.nrrd"
series = "3:2"
[[lesions]]
id = "L1"
point_lps_mm = [56.2, -23.1, -14.9]
radius_mm = 6
[[lesions]]
markups = "l.mrk.json"
[nipple]
point_lps_mm = [1, 2, 3]
[fit]
elements = [4, 4, 1]
smoothing = 1e-8
[labels]
fat = [1, 7]
[views.cc]
thickness_mm = 56.0
mammogram = "cc.dcm"
pectoral = [[1, 2], [3, 4]]
[views.mlo]
angle_deg = 45.0
)";

void write_texts(const Seeds& seeds) {
  seeds.text("patient_toml", "patient.toml", kToml);
  write_markups(seeds.at("markups", "whole.mrk.json"), {{"L1", {1, 2, 3}, "a lesion"}});
  LesionRow row;
  row.patient = "042", row.lesion = "L1, \"left\"", row.view = "cc", row.side = "left";
  row.depth_mm = 12.5, row.detector_u_mm = 30, row.detector_v_mm = -4;
  row.registration = "look";
  write_lesion_table(seeds.at("lesion_table", "lesions.csv"), {row});
  const fs::path product = seeds.at("sidecar", "a.vtu");
  std::ofstream(product) << "mesh";
  write_sidecar(product,
                make_sidecar(product,
                             make_provenance("fit", {{"fit.shape", {{"value", 1}, {"unit", "-"}}}},
                                             {{"a.vtu", product, true}}, product),
                             {Status::look, {"because"}, {{"rms_mm", 0.25}, {"history", {1, 2}}}},
                             {"a.vtu"}, {"mammotwin-fit a.vtu", 1.5, 210, false}));
  fs::remove(product);
  CompressionCheckpoint checkpoint;
  checkpoint.found.assign(2, HermiteMesh::Node::Ones());
  checkpoint.reached.state = {checkpoint.found, {1, 2}};
  checkpoint.sticking.resize(1);
  const auto bytes = encode_checkpoint(checkpoint, "run");
  seeds.text("checkpoint", "whole", std::string(bytes.begin(), bytes.end()));
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  if (argc != 2) return std::cerr << "usage: fuzz_seeds FOLDER\n", 2;
  const Seeds seeds(argv[1]);
  write_images(seeds);
  write_segmentations(seeds);
  write_meshes(seeds);
  write_surfaces(seeds);
  write_mammograms(seeds);
  write_texts(seeds);
}
