#include "registration/export/markups.h"

#include "segmentation/files/markups.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void markups(const std::string& bytes) {
  const auto path = fuzzed_file("a.mrk.json", bytes);
  read_markups_points(path);
  read_markups_point(path);
  read_markups(path);
}

}  // namespace mammotwin::fuzz
