// mammotwin-try-read raw_header|dicom: reads the files whose names, each ended by a zero byte, come
// on stdin, and writes one byte before each. Started by first_fatal (trial_read.h).

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <new>
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

/// Of address space: 256 MB, of which libraries take 40, and what the largest file may unfold to.
rlim_t most_memory(const std::vector<std::string>& files) {
  constexpr rlim_t base = rlim_t{256} << 20, most = rlim_t{4} << 30, unfolded = 16;
  rlim_t largest = 0;
  for (const std::string& file : files) {
    std::error_code none;
    const auto size = std::filesystem::file_size(file, none);
    if (!none) largest = std::max<rlim_t>(largest, size);
  }
  return base + unfolded * std::min(largest, (most - base) / unfolded);
}

/// Of processor time: a header takes a millisecond, a slice at most tenths of a second.
rlim_t most_seconds(const std::vector<std::string>& files) { return 3 + files.size() / 5; }

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view trial = argc == 2 ? argv[1] : "";
  if (trial != "raw_header" && trial != "dicom") return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::vector<std::string> files;
  for (std::string name; std::getline(std::cin, name, '\0');) files.push_back(name);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, most_memory(files));
  limit(RLIMIT_CPU, most_seconds(files));
  std::set_new_handler(
      [] { _exit(1); });  // libraries catch std::bad_alloc, and who asked would wait
  for (const std::string& file : files) {
    if (write(STDOUT_FILENO, ".", 1) != 1) return 1;
    try {
      read(trial == "dicom", file);
    } catch (...) {  // who asked meets it again, and says it
    }
  }
  _exit(0);  // what libraries do at the end is not tried
}
