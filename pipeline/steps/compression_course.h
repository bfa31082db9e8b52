#pragma once

#include "solver/press/compression_result.h"

namespace mammotwin {

/// The breast after one load step.
struct CourseStep {
  double thickness_mm = 0;
  std::vector<HermiteMesh::Node> nodes;
};

/// Adds to a compressed mesh's metadata how the breast came there.
void remember_course(const CompressionReport& report, MeshFile& compressed);

/// The way back out of such a file: from the shape free of stress, as thick as it is then, to that
/// of the file. Empty where the file was written without.
std::vector<CourseStep> course_of(const MeshFile& compressed);

/// Writes one mesh a step, called `<stem>_00.vtu` and so on, with `metadata:thickness_mm` as field
/// data, and `collection`, which names them, for ParaView to show as a series over the steps.
/// `file_named` gives where a file goes that stands beside the collection under that name.
void write_course(const MeshFile& compressed, const std::vector<CourseStep>& course,
                  const std::string& stem, const std::filesystem::path& collection,
                  const std::function<std::filesystem::path(const std::string& name)>& file_named);

}  // namespace mammotwin
