#pragma once

#include <filesystem>
#include <string>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// What a search may be told wrongly, or not at all.
inline constexpr const char* kSpoils[] = {"nipple", "pectoral", "abdomen"};

/// Copies a made registration case and spoils it. "nipple": no marker in either mammogram, so that
/// the nipple is not in profile; "pectoral": 10 mm of the MLO along the chest wall said to be
/// muscle; "abdomen": a fold of it below the breast in the MLO. What is there already is kept.
/// Throws std::runtime_error where the case has no marker to take away, or its files are missing.
void spoil_registration_case(const std::filesystem::path& made, const std::string& spoil,
                             const std::filesystem::path& folder);

/// Draws a round fold of abdomen over the breast's lower end into an oblique mammogram.
void add_abdomen(const std::filesystem::path& mammogram);

/// Draws a fold of doubled skin into a mammogram: a bright line of 4 mm from the upper skin 40 mm
/// towards the breast's middle, that fades.
void add_skin_fold(const std::filesystem::path& mammogram, bool oblique);

/// Copies the files of a case.
void copy_case(const std::filesystem::path& made, const std::filesystem::path& folder);

/// A mammogram as the PNG of 16 bits that it was read from.
void write_grey(const std::filesystem::path& path, const MammogramImage& image);

}  // namespace mammotwin
