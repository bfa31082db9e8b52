// mammotwin-try-read raw_header|dicom: reads the files whose names, each ended by a zero byte, come
// on stdin, and writes one byte before each. Started by first_fatal (trial_read.h).

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "segmentation/files/dicom_slice.h"
#include "segmentation/files/read_raw_image.h"

namespace {

void read(bool dicom, const std::filesystem::path& file) {
  if (!dicom) return mammotwin::try_raw_header(file);
  const auto slices = mammotwin::read_dicom_slices(file);
  if (!slices.empty() && slices.front().modality == "MR") mammotwin::read_dicom_pixels(file);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view trial = argc == 2 ? argv[1] : "";
  if (trial != "raw_header" && trial != "dicom") return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  constexpr rlim_t most_memory = rlim_t{4} << 30;  // twice the largest image that is read
  const rlimit no_core{0, 0}, memory{most_memory, most_memory};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_AS, &memory);
  std::vector<std::string> files;
  for (std::string name; std::getline(std::cin, name, '\0');) files.push_back(name);
  for (const std::string& file : files) {
    if (write(STDOUT_FILENO, ".", 1) != 1) return 1;
    try {
      read(trial == "dicom", file);
    } catch (...) {  // who asked meets it again, and says it
    }
  }
  _exit(0);  // what libraries do at the end is not tried
}
