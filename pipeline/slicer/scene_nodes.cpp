#include "pipeline/slicer/scene_nodes.h"

#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\n')
      out += "&#10;";
    else
      out += c;
  }
  return out;
}

std::string shown(const Colour& c) {
  return word::number(c.red, 3) + " " + word::number(c.green, 3) + " " + word::number(c.blue, 3);
}

std::string truth(bool value) { return value ? "true" : "false"; }

constexpr double kModelOpacity = 0.5;  // lesions show through
constexpr double kGlyph = 1.2;         // [% of the view], a third of Slicer's own

std::vector<std::pair<std::string, std::string>> markups_display(const Colour& colour,
                                                                 bool visible) {
  return {{"selectedColor", shown(colour)},
          {"color", shown(colour)},
          {"useGlyphScale", "true"},
          {"glyphScale", word::number(kGlyph, 1)},
          {"visibility", truth(visible)}};
}

/// Slicer's attributes of an item are pairs name^value, each ended by |.
std::string opened_item(int id, int parent, const std::string& name, const std::string& level) {
  return "<SubjectHierarchyItem id=\"" + std::to_string(id) + "\" name=\"" + escaped(name) +
         "\" parent=\"" + std::to_string(parent) +
         "\" type=\"\" expanded=\"true\" attributes=\"Level^" + level + "|\">\n";
}

}  // namespace

std::string SceneNodes::add(const std::string& tag, const std::string& type,
                            Attributes attributes) {
  const std::string id = "vtkMRML" + type + "Node" + std::to_string(++count_[type]);
  std::string line = "  <" + tag + " id=\"" + id + "\"";
  for (const auto& [key, value] : attributes) line += " " + key + "=\"" + escaped(value) + "\"";
  lines_.push_back(line + "></" + tag + ">");
  return id;
}

std::string SceneNodes::add_item(const std::string& tag, const std::string& name,
                                 const std::string& storage, Attributes storage_attributes,
                                 const std::string& display, Attributes display_attributes,
                                 const std::string& references) {
  std::string refers = "storage:" + add(storage, storage, std::move(storage_attributes)) + ";";
  if (!display.empty()) {
    const std::string type = tag == "Volume" ? "ScalarVolumeDisplay" : display;
    refers += "display:" + add(display, type, std::move(display_attributes)) + ";";
  }
  const std::string id = add(tag, tag == "Volume" ? "ScalarVolume" : tag,
                             {{"name", name}, {"references", refers + references}});
  const std::string family = tag.starts_with("Markups") ? "Markups" : tag + "s";
  if (!folders_.empty()) folders_.back().items.emplace_back(id, family);
  return id;
}

std::string SceneNodes::add_volume(const std::string& name, const std::string& file) {
  return add_item("Volume", name, "VolumeArchetypeStorage",
                  {{"fileName", file}, {"centerImage", "0"}}, "VolumeDisplay",
                  {{"colorNodeRef", "vtkMRMLColorTableNodeGrey"},
                   {"autoWindowLevel", "1"},
                   {"interpolate", "1"}});
}

void SceneNodes::add_segmentation(const std::string& name, const std::string& file,
                                  const std::string& on_volume) {
  add_item("Segmentation", name, "SegmentationStorage", {{"fileName", file}}, "SegmentationDisplay",
           {{"visibility", "true"}, {"opacity", "0.5"}},
           on_volume.empty() ? "" : "referenceImageGeometryRef:" + on_volume + ";");
}

void SceneNodes::add_model(const std::string& name, const std::string& file, const Colour& colour,
                           bool visible, const std::string& numbers) {
  Attributes display = {{"color", shown(colour)},
                        {"opacity", word::number(kModelOpacity, 2)},
                        {"visibility", truth(visible)},
                        {"visibility2D", "true"}};
  if (!numbers.empty())
    display.insert(display.end(),
                   {{"activeScalarName", numbers},
                    {"scalarVisibility", "false"},
                    {"colorNodeRef", "vtkMRMLColorTableNodeFileDivergingBlueRed.txt"}});
  add_item("Model", name, "ModelStorage", {{"fileName", file}, {"coordinateSystem", "LPS"}},
           "ModelDisplay", display);
}

void SceneNodes::add_markups(const std::string& name, const std::string& file, const Colour& colour,
                             bool visible) {
  add_item("MarkupsFiducial", name, "MarkupsJsonStorage",
           {{"fileName", file}, {"coordinateSystem", "LPS"}}, "MarkupsDisplay",
           markups_display(colour, visible));
}

void SceneNodes::add_closed_curve(const std::string& name, const std::string& file,
                                  const Colour& colour, bool visible) {
  auto display = markups_display(colour, visible);
  display.emplace_back("pointLabelsVisibility", "false");
  add_item("MarkupsClosedCurve", name, "MarkupsJsonStorage",
           {{"fileName", file}, {"coordinateSystem", "LPS"}}, "MarkupsDisplay", display);
}

void SceneNodes::add_transform(const std::string& name, const std::string& file) {
  add_item("Transform", name, "TransformStorage", {{"fileName", file}}, "", {});
}

void SceneNodes::show_in_slices(const std::string& volume) {
  for (const char* slice : {"Red", "Yellow", "Green"})
    lines_.push_back("  <SliceComposite id=\"vtkMRMLSliceCompositeNode" + std::string(slice) +
                     "\" singletonTag=\"" + slice + "\" layoutName=\"" + slice +
                     "\" backgroundVolumeID=\"" + volume + "\"></SliceComposite>");
}

void SceneNodes::show_orientation() {
  lines_.push_back(
      "  <View id=\"vtkMRMLViewNode1\" singletonTag=\"1\" layoutName=\"1\" "
      "orientationMarkerType=\"human\" orientationMarkerSize=\"medium\"></View>");
}

/// The data tree: folders below the scene, each with its items (vtkMRMLSubjectHierarchyNode).
std::string SceneNodes::hierarchy() const {
  constexpr int kScene = 3;  // Slicer keeps 1 and 2 for itself
  int id = kScene;
  std::string text =
      "  <SubjectHierarchy id=\"vtkMRMLSubjectHierarchyNode1\" name=\"SubjectHierarchy\" "
      "attributes=\"SubjectHierarchyVersion:2\">\n    " +
      opened_item(kScene, 0, "Scene", "Scene");
  for (const Folder& folder : folders_) {
    if (folder.items.empty()) continue;
    const int parent = ++id;
    text += "      " + opened_item(parent, kScene, folder.name, "Folder");
    for (const auto& [node, family] : folder.items)
      text += "        <SubjectHierarchyItem id=\"" + std::to_string(++id) + "\" dataNode=\"" +
              node + "\" parent=\"" + std::to_string(parent) + "\" type=\"" + family +
              "\"></SubjectHierarchyItem>\n";
    text += "      </SubjectHierarchyItem>\n";
  }
  return text + "    </SubjectHierarchyItem>\n  </SubjectHierarchy>\n";
}

std::string SceneNodes::text() const {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<MRML version=\"Slicer 5.0.3\">\n";
  for (const std::string& line : lines_) text += line + "\n";
  return text + hierarchy() + "</MRML>\n";
}

}  // namespace mammotwin
