#pragma once

#include "pointfront/Points/AttributePass.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The attributes that a user wants computed between the inputs and the tree, from the tool, VTK or
/// Python.
/// Units  lengths in the units of the coordinates.
struct PassChoice
{
  enum class Normals : std::uint8_t
  {
    None,
    ScanLine, ///< from neighbours in the scan
    PCA, ///< from planes through the nearest points
    PCL ///< likewise; the Point Cloud Library fits the planes, in single precision
  };

  std::string targetCrs; ///< a code, a definition, a file with one, "utm"; empty: the inputs'
  std::string assumedCrs; ///< system of inputs that name none; empty: unknown
  /// The two in messages, by the names that their user knows.
  std::string targetCrsName = "--crs";
  std::string assumedCrsName = "--assume-crs";
  /// Whether inputs could name a system, so that it is worth a warning if none does; points in a
  /// program's memory could not.
  bool inputsMayNameCrs = true;

  std::vector<std::string> colourFrom; ///< georeferenced images: files, patterns, folders
  std::vector<std::string> attributeFrom; ///< likewise, NAME=IMAGE; without NAME= as the one before

  Normals normals = Normals::None;
  std::uint32_t normalsNeighbours = 16; ///< points of a plane, with the point itself; 3 to 4096
  double normalsRadius = 0.0; ///< if > 0, instead: all points within
  double normalsEps = 0.0; ///< bound of an approximate search, 0 (exact) to 1000
  bool curvature = false; ///< attribute "curvature" too; of planes only
  /// Classes that get normals; nothing: all.
  std::optional<std::vector<std::uint8_t>> normalsClasses;

  /// Attribute "splat_radius" for all points. Normals from planes bring it too, for the classes
  /// with normals.
  bool splatRadius = false;

  bool localHeight = false;
  double localHeightRadius = 5.0; ///< 1e-3 to 1e6
  bool heightAboveGround = false;
  /// Whether a point of the cloud is of class 2, for inputs that are a part of it; nothing: looked
  /// for.
  std::optional<bool> groundClassified;
  double groundCell = 10.0; ///< where no point is of class 2: of the lowest points; 1e-3 to 1e6
};

} // namespace pointfront
