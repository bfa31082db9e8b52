#include "pipeline/steps/view_header.h"

#include <stdexcept>

#include "registration/mammogram/header_geometry.h"

namespace mammotwin {
namespace {

HeaderOverrides overrides_of(const ViewSettings& view) {
  return {view.thickness_mm,     view.angle_deg,  view.source_distance_mm, view.support_gap_mm,
          view.pixel_spacing_mm, view.chest_wall, view.lateral_at_top};
}

void take(const HeaderGeometry& header, ViewSettings& view) {
  const PixelGrid& pixels = *header.detector.pixels;
  view.thickness_mm = header.thickness_mm;
  view.angle_deg = header.angle_deg;
  view.source_distance_mm = header.detector.source_distance_mm;
  view.support_gap_mm = header.detector.support_gap_mm;
  view.pixel_spacing_mm = pixels.spacing_mm;
  view.columns = pixels.columns;
  view.rows = pixels.rows;
  view.chest_wall = pixels.chest_wall;
  view.lateral_at_top = pixels.lateral_at_top;
}

}  // namespace

std::optional<std::filesystem::path> dicom_mammogram(const Patient& patient,
                                                     const std::string& view) {
  const auto& named = patient.view(view).mammogram;
  if (!named) return std::nullopt;
  const std::filesystem::path path = patient.resolve(*named);
  if (!is_dicom(path)) return std::nullopt;
  return path;
}

ViewSettings with_header(const Patient& patient, const std::string& name, Side side,
                         std::vector<std::string>& remarks) {
  ViewSettings view = patient.view(name);
  const auto path = dicom_mammogram(patient, name);
  if (!path) return view;
  const std::string file = path->filename().string();
  try {
    const HeaderGeometry header =
        header_geometry(read_mammogram_header(*path), name, side, overrides_of(view));
    for (const std::string& remark : header.remarks) remarks.push_back(file + ": " + remark);
    take(header, view);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  return view;
}

}  // namespace mammotwin
