#pragma once

#include "pointfront/Quality/QualityChoice.h"
#include "pointfront/Style/StyleSheet.h"

#include <CLI/CLI.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The back end that draws the points.
enum class DrawingBackend : std::uint8_t
{
  Auto, ///< Software
  Software, ///< the tool itself: needs no display and no GL
  OpenGL ///< VTK, in a window that is not shown
};

/// The options that `render` and `bench` share: which stores, and how they are drawn.
struct DrawingOptions
{
  std::vector<std::string> stores;
  DrawingBackend backend = DrawingBackend::Auto;
  std::array<int, 2> size{ 1280, 720 }; ///< pixels
  std::array<double, 3> background{ 0.09, 0.10, 0.12 }; ///< 0 to 1
  std::string colourBy; ///< empty: defaultColourAttribute()
  double pointSizePx = 0.0; ///< 0: auto
  double errorPx = 1.0; ///< projected point spacing
  std::uint64_t memoryBytes = 0; ///< points of all stores, and the picture; 0: the library's
  std::int64_t pointBudget = -1; ///< most points drawn; -1: not given
  std::uint64_t gpuBytes = 0; ///< most GPU memory for points; 0: no limit but the points
  double frameMs = 0.0; ///< while the camera moves; 0: that VTK allots
  double growthMs = 250.0; ///< that detail takes to its size, in frames that follow others
  bool measureEmptyScene = false; ///< see StoreScene::emptySceneBytes()
  std::vector<std::uint8_t> classes; ///< sorted codes of what is drawn; empty: all
  bool eyeDomeLighting = false;
  std::optional<bool> lit;
  /// --style, changed by --technique, --color-by, --point-size, --where, --classes and --edl.
  /// Complete when parsing is.
  StyleSheet style;
  std::string qualityAsked; ///< --quality, as it was written
  /// The place that --quality chose from the curve, where it was a number.
  std::optional<QualityChoice> quality;
  std::string detail = "front"; ///< or "view": how the detail of a view is chosen

  /// Adds the options to a command; this object must outlive the parsing.
  void declare(CLI::App& app);
};

/// "R,G,B", each 0 to 255, or each 0 to 1 if none is larger than 1. Nothing for wrong text.
std::optional<std::array<double, 3>> parseColour(const std::string& text);

} // namespace pointfront
