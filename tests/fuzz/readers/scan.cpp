#include "fitting/scan/scan_cloud.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void scan(const std::string& bytes) {
  const char* name = bytes.starts_with("ply")                             ? "b.ply"
                     : bytes.starts_with("OFF") || bytes.starts_with("#") ? "b.off"
                     : bytes.starts_with("v ")                            ? "b.obj"
                     : bytes.starts_with("solid")                         ? "b.stl"
                                                                          : "b.xyz";
  read_scan_points(fuzzed_file(name, bytes), 1);
}

}  // namespace mammotwin::fuzz
