#include "pipeline/evaluate/cases/breasts_to_press.h"

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/evaluate/cases/real_breasts.h"
#include "pipeline/frame/products.h"

namespace mammotwin {

namespace fs = std::filesystem;

std::vector<BreastToPress> breasts_to_press(const fs::path& patient_toml, const fs::path& cases,
                                            const std::vector<std::string>& only,
                                            const fs::path& folder) {
  const fs::path patient = fs::absolute(patient_toml);
  const std::string first = patient.parent_path().filename();
  std::vector<BreastToPress> breasts{{first, patient, folder / first}};
  for (const RealBreast& real : real_breasts(cases)) {
    BreastToPress breast{name_and_side(real), {}, {}};
    if (!is_asked(breast.name, only)) continue;
    breast.folder = folder / breast.name;
    breast.patient_toml = breast.folder / "patient.toml";
    fs::create_directories(breast.folder);
    write_text_atomically(
        breast.patient_toml,
        patient_toml_of(real) + "[views.cc]\nthickness_mm = 55\n[views.mlo]\nthickness_mm = 55\n");
    breasts.push_back(breast);
  }
  return breasts;
}

}  // namespace mammotwin
