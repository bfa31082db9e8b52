#include "fitting/surface/read_surface.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

/// In the format that the first bytes tell, binary STL where they tell none.
void surface(const std::string& bytes) {
  const char* name = bytes.starts_with("ply")                             ? "a.ply"
                     : bytes.starts_with("OFF") || bytes.starts_with("#") ? "a.off"
                     : bytes.starts_with("v ")                            ? "a.obj"
                                                                          : "a.stl";
  read_surface(fuzzed_file(name, bytes));
}

}  // namespace mammotwin::fuzz
