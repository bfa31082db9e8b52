#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/report/drawing/picture.h"

namespace mammotwin {

/// A 3D Slicer scene (.mrml) as it grows: every item is a node with a storage node that names its
/// file, and where it is drawn a display node. Files are named relative to the scene. The nodes and
/// attributes are those that Slicer 5 reads (Libs/MRML/Core).
class SceneNodes {
 public:
  /// Returns the volume's id, for `show_in_slices`.
  std::string add_volume(const std::string& name, const std::string& file);
  void add_segmentation(const std::string& name, const std::string& file,
                        const std::string& on_volume);
  /// `file` in LPS. `numbers`: the point numbers that colour it, else `colour`.
  void add_model(const std::string& name, const std::string& file, const Colour& colour, bool shown,
                 const std::string& numbers = "");
  void add_markups(const std::string& name, const std::string& file, const Colour& colour,
                   bool shown);
  void add_closed_curve(const std::string& name, const std::string& file, const Colour& colour,
                        bool shown);
  /// A displacement field as the transform that Slicer applies to what lives on the field's target.
  void add_transform(const std::string& name, const std::string& file);
  /// What is added from here on lies in that folder of the data tree (subject hierarchy).
  void begin_folder(const std::string& name) { folders_.push_back({name, {}}); }
  /// A figure of a person in the 3-D view's corner that says which way one looks.
  void show_orientation();
  /// Behind the three slice views.
  void show_in_slices(const std::string& volume);

  std::string text() const;

 private:
  using Attributes = std::vector<std::pair<std::string, std::string>>;
  std::string add(const std::string& tag, const std::string& type, Attributes attributes);
  /// An item with its storage and, if `display` is a tag, its display; returns the item's id.
  std::string add_item(const std::string& tag, const std::string& name, const std::string& storage,
                       Attributes storage_attributes, const std::string& display,
                       Attributes display_attributes, const std::string& references = "");

  std::string hierarchy() const;

  struct Folder {
    std::string name;
    std::vector<std::pair<std::string, std::string>> items;  ///< node, plug-in that shows it
  };
  std::vector<std::string> lines_;
  std::vector<Folder> folders_;
  std::map<std::string, int> count_;
};

}  // namespace mammotwin
