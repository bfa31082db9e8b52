#include "pipeline/steps/view_header.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "registration/mammogram/mammogram_picture.h"
#include "registration/mammogram/mammogram_pixels.h"

namespace mammotwin {
namespace {

/// A file that is neither must not be taken for a view without a mammogram.
void require_picture(const std::filesystem::path& path, const std::string& key) {
  if (!is_mammogram_picture(path))
    throw std::runtime_error(key +
                             ": the file is no DICOM, PNG or JPEG; expected one of them (is it "
                             "damaged? copy or export it again)");
}

/// A contour's points: a column and a row a line, parted by blanks or a comma.
std::vector<Eigen::Vector2d> read_contour(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<Eigen::Vector2d> contour;
  for (std::string line; std::getline(in, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    Eigen::Vector2d x;
    if (numbers >> x.x() >> x.y())
      contour.push_back(x);
    else if (line.find_first_not_of(" \t\r") != std::string::npos && !contour.empty())
      throw std::runtime_error(path.string() + ": line \"" + line +
                               "\" is no column and row in pixels");
  }
  if (contour.size() < 2)
    throw std::runtime_error(path.string() +
                             ": holds fewer than two points; expected a mask (PNG) or a contour, a "
                             "column and a row a line");
  return contour;
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
  if (const auto& slices = header.detector.slices) {
    view.slice_count = slices->count;
    view.slice_spacing_mm = slices->spacing_mm;
    view.lowest_slice_mm = slices->lowest_mm;
    view.first_slice_at_support = slices->first_at_support;
  }
}

/// A picture says how large it is, and nothing else.
void take_picture_size(const Patient& patient, ViewSettings& view) {
  if (!view.mammogram || !view.pixel_spacing_mm || view.columns || view.rows) return;
  const PictureSize size = mammogram_picture_size(patient.resolve(*view.mammogram));
  view.columns = size.columns;
  view.rows = size.rows;
}

}  // namespace

HeaderOverrides overrides_of(const ViewSettings& view) {
  return {view.thickness_mm,
          view.angle_deg,
          view.source_distance_mm,
          view.support_gap_mm,
          view.pixel_spacing_mm,
          view.chest_wall,
          view.lateral_at_top,
          {view.slice_spacing_mm, view.lowest_slice_mm, view.first_slice_at_support}};
}

SaidFindings said_in(const Patient& patient, const ViewSettings& view) {
  SaidFindings said;
  said.nipple = view.nipple_pixel;
  if (view.pectoral.size() == 2) said.pectoral = {view.pectoral[0], view.pectoral[1]};
  if (!view.outline) return said;
  const std::filesystem::path path = patient.resolve(*view.outline);
  if (path.extension() == ".png")
    said.mask = read_mammogram_picture(path);
  else
    said.outline = read_contour(path);
  return said;
}

std::optional<std::filesystem::path> dicom_mammogram(const Patient& patient,
                                                     const std::string& view) {
  const auto& named = patient.view(view).mammogram;
  if (!named) return std::nullopt;
  const std::filesystem::path path = patient.resolve(*named);
  if (is_dicom(path)) return path;
  require_picture(path, "views." + view + ".mammogram");
  return std::nullopt;
}

void require_whole_mammogram(const Patient& patient, const std::string& view) {
  const auto& named = patient.view(view).mammogram;
  if (!named) return;
  try {
    read_mammogram(patient.resolve(*named));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("the " + view + " mammogram: " + error.what());
  }
}

ViewSettings with_header(const Patient& patient, const std::string& name, Side side,
                         std::vector<std::string>& remarks) {
  ViewSettings view = patient.view(name);
  const auto path = dicom_mammogram(patient, name);
  if (!path) {
    take_picture_size(patient, view);
    return view;
  }
  const std::string role = "the " + name + " mammogram";  // files are named after patients
  try {
    const HeaderGeometry header =
        header_geometry(read_mammogram_header(*path), name, side, overrides_of(view));
    for (const std::string& remark : header.remarks) remarks.push_back(role + ": " + remark);
    take(header, view);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(role + ": " + error.what());
  }
  return view;
}

}  // namespace mammotwin
