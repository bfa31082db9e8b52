#include "fitting/mesh/mesh_file.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void mesh(const std::string& bytes) { read_mesh_file(fuzzed_file("a.vtu", bytes)); }

}  // namespace mammotwin::fuzz
