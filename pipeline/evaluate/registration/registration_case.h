#pragma once

#include <filesystem>
#include <string>

namespace mammotwin {

/// How far from the registering model's world a case is drawn.
enum class Difficulty { coarse, easy, hard, fatty };

/// Makes synthetic patient n in `folder`: mri.nrrd, cc.png, mlo.png, patient.toml, landmarks.csv
/// (lesions first, then points spread through the gland) and drawn.json. What is there already is
/// kept. `coarse`: easy on few elements, to try it out; `fatty`: easy, with next to no gland, one
/// lesion of 8 mm, and points in fat; what is hard stands in README.md. Throws std::runtime_error
/// where the truth cannot be made.
void make_registration_case(int number, Difficulty difficulty, const std::filesystem::path& folder);

/// Makes patient 042 with tomosynthesis in place of both mammograms: cc.dcm, mlo.dcm (all that
/// registration needs to know is in their headers) and slices.json, the slice of each lesion. Truth
/// is of another model, as above.
void make_tomosynthesis_case(bool coarse, const std::filesystem::path& folder);

/// Has its patient.toml name another materials.preset than that of its truth.
void take_tissue(const std::string& preset, const std::filesystem::path& folder);

/// Takes it through segment, fit, unload, compress and register, which skip what is current.
/// Throws std::runtime_error with the reason of a stage that leaves no product.
void run_registration_case(const std::filesystem::path& folder);

}  // namespace mammotwin
