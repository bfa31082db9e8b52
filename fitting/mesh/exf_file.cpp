#include <fstream>
#include <iomanip>
#include <limits>
#include <stdexcept>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

namespace {

constexpr const char* components[] = {"x", "y", "z"};
constexpr const char* coordinates =
    "1) coordinates, coordinate, rectangular cartesian, real, #Components=3\n";

void write_nodes(std::ostream& out, const HermiteMesh& mesh) {
  out << "!#nodeset nodes\nDefine node template: node1\nShape. Dimension=0\n#Fields=1\n"
      << coordinates;
  for (const char* c : components)
    out << " " << c
        << ". #Values=8 (value,d/ds1,d/ds2,d2/ds1ds2,d/ds3,d2/ds1ds3,d2/ds2ds3,d3/ds1ds2ds3)\n";
  out << "Node template: node1\n";
  for (int n = 0; n < mesh.num_nodes(); ++n) {
    out << "Node: " << n + 1 << "\n";
    for (int a = 0; a < 3; ++a) {
      for (int d = 0; d < 8; ++d) out << " " << mesh.node(n)(a, d);
      out << "\n";
    }
  }
}

void write_element_template(std::ostream& out) {
  out << "!#mesh mesh3d, dimension=3, nodeset=nodes\nDefine element template: element1\n"
         "Shape. Dimension=3, line*line*line\n#Scale factor sets=0\n#Nodes=8\n#Fields=1\n"
      << coordinates;
  for (const char* c : components) {
    out << " " << c << ". c.Hermite*c.Hermite*c.Hermite, no modify, standard node based.\n"
        << "  #Nodes=8\n";
    for (int n = 1; n <= 8; ++n)
      out << "  " << n << ". #Values=8\n   Value labels: value d/ds1 d/ds2 d2/ds1ds2 d/ds3 "
          << "d2/ds1ds3 d2/ds2ds3 d3/ds1ds2ds3\n";
  }
}

void write_elements(std::ostream& out, const HermiteMesh& mesh) {
  out << "Element template: element1\n";
  for (int e = 0; e < mesh.num_elements(); ++e) {
    out << "Element: " << e + 1 << "\n Nodes:\n";
    for (int node : mesh.corners(e)) out << " " << node + 1;
    out << "\n";
  }
}

}  // namespace

void write_exf(const std::filesystem::path& path, const HermiteMesh& mesh) {
  std::ofstream out(path);
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  out << "EX Version: 2\nRegion: /\n";
  write_nodes(out, mesh);
  write_element_template(out);
  write_elements(out, mesh);
  out.flush();
  if (!out)
    throw std::runtime_error(path.string() + ": cannot be written; is the disk full or read-only?");
}

}  // namespace mammotwin
