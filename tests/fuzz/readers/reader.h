#pragma once

#include <filesystem>
#include <string>

namespace mammotwin {

/// Reads `bytes` as the program reads a file of that kind. Returns where they were taken; throws
/// what the reader throws where they were refused. One function a file of this folder.
namespace fuzz {
void nifti(const std::string& bytes);
void nrrd(const std::string& bytes);
void meta_image(const std::string& bytes);
void dicom_mri(const std::string& bytes);
void segmentation(const std::string& bytes);
void mesh(const std::string& bytes);
void surface(const std::string& bytes);
void scan(const std::string& bytes);
void mammogram_dicom(const std::string& bytes);
void mammogram_png(const std::string& bytes);
void patient_toml(const std::string& bytes);
void markups(const std::string& bytes);
void sidecar(const std::string& bytes);
void checkpoint(const std::string& bytes);
void lesion_table(const std::string& bytes);
}  // namespace fuzz

/// Writes the bytes under a name in a folder of this process's own and returns the path.
std::filesystem::path fuzzed_file(const std::string& name, const std::string& bytes);

/// What a user may be told of a file of these bytes: a sentence, and no library's words for
/// programmers, but where the file has them and is quoted.
bool is_said_to_a_user(const std::string& message, const std::string& bytes);

}  // namespace mammotwin
