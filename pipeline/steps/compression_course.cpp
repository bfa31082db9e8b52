#include "pipeline/steps/compression_course.h"

#include <fstream>
#include <stdexcept>

namespace mammotwin {
namespace {

constexpr const char* kThicknesses = "course_thickness_mm";
constexpr const char* kNodes = "course_nodes";  // of all steps, one after the other

/// The shape that the plates found.
const std::vector<HermiteMesh::Node>& start_of(const MeshFile& compressed) {
  const auto& shapes = compressed.configurations;
  const auto unloaded = shapes.find("unloaded");
  return unloaded != shapes.end() ? unloaded->second : shapes.at("prone");
}

std::string numbered(std::size_t step) {
  const std::string digits = std::to_string(step);
  return std::string(digits.size() < 2 ? 1 : 0, '0') + digits;
}

}  // namespace

void remember_course(const CompressionReport& report, MeshFile& compressed) {
  std::vector<double>& thicknesses = compressed.metadata[kThicknesses];
  std::vector<double>& nodes = compressed.metadata[kNodes];
  thicknesses = {report.free_thickness_mm};
  nodes.clear();
  for (std::size_t i = 0; i + 1 < report.history.size(); ++i) {
    thicknesses.push_back(report.history[i].thickness_mm);
    for (const HermiteMesh::Node& node : report.history[i].deformed)
      nodes.insert(nodes.end(), node.data(), node.data() + node.size());
  }
  thicknesses.push_back(report.thickness_mm);
}

std::vector<CourseStep> course_of(const MeshFile& compressed) {
  const auto thicknesses = compressed.metadata.find(kThicknesses);
  const auto nodes = compressed.metadata.find(kNodes);
  if (thicknesses == compressed.metadata.end() || nodes == compressed.metadata.end()) return {};
  const std::size_t steps = thicknesses->second.size();
  const std::size_t size = HermiteMesh::Node::SizeAtCompileTime;
  const std::size_t count = compressed.mesh.nodes().size();
  if (steps < 2 || nodes->second.size() != (steps - 2) * count * size)
    throw std::runtime_error("the way to the compressed shape is damaged; run compress again");
  std::vector<CourseStep> course(steps);
  const double* x = nodes->second.data();
  for (std::size_t s = 0; s < steps; ++s) {
    course[s].thickness_mm = thicknesses->second[s];
    for (std::size_t n = 0; s > 0 && s + 1 < steps && n < count; ++n, x += size)
      course[s].nodes.push_back(Eigen::Map<const HermiteMesh::Node>(x));
  }
  course.front().nodes = start_of(compressed);
  course.back().nodes = compressed.mesh.nodes();
  return course;
}

void write_course(const MeshFile& compressed, const std::vector<CourseStep>& course,
                  const std::string& stem, const std::filesystem::path& collection,
                  const std::function<std::filesystem::path(const std::string& name)>& file_named) {
  std::ofstream out(collection);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n <Collection>\n";
  for (std::size_t s = 0; s < course.size(); ++s) {
    MeshFile file{HermiteMesh(course[s].nodes, compressed.mesh.elements()),
                  compressed.faces,
                  compressed.ties,
                  compressed.configurations,
                  {{"thickness_mm", {course[s].thickness_mm}}},
                  {}};
    const std::string name = stem + "_" + numbered(s) + ".vtu";
    write_mesh_file(file_named(name), file);
    out << "  <DataSet timestep=\"" << s << "\" part=\"0\" file=\"" << name << "\"/>\n";
  }
  out << " </Collection>\n</VTKFile>\n";
  if (!out) throw std::runtime_error(collection.string() + ": cannot be written");
}

}  // namespace mammotwin
