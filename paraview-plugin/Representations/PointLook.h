#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Style/LayerStyle.h"
#include "pointfront/Style/QualityPreset.h"

#include <array>
#include <optional>
#include <string>

class vtkScalarsToColors;

namespace pointfront
{

struct StyleSheet;

/// A technique as the properties name it: a style sheet's name, or "blended": splats in two passes.
struct NamedTechnique
{
  Technique technique = Technique::Points;
  std::optional<bool> blended; ///< nothing: as the technique has it
};
std::optional<NamedTechnique> namedTechnique(const std::string& name);
/// "points, splats ... blended".
std::string namedTechniques();

/// How a representation's properties say that points look: what ParaView's own properties cannot.
/// Threads  a value.
struct PointLook
{
  /// Where points are as large as it takes to close the surface, times `factor`; else `pixels`.
  enum Closing
  {
    NEVER = 0,
    ALWAYS = 1,
    BY_TECHNIQUE = 2 ///< with every technique but points
  };
  std::string technique = "points"; ///< namedTechnique()
  int closing = BY_TECHNIQUE;
  double pixels = 2.0; ///< > 0
  double factor = 1.0; ///< > 0
  double eyeDomeStrength = 0.0; ///< 0: off
  /// A preset or a number, as chooseQuality() has it, in the place of technique and closing;
  /// empty: none.
  std::string quality;
  enum Light
  {
    SPHERES = 0,
    ALL = 1,
    NONE = 2
  };
  int light = SPHERES; ///< which points with normals are lit
  bool fillHoles = false;
  double opacity = 1.0;
  /// Opacity is that of a surface, which the style draws: what else draws it is opaque. Else the
  /// actor has it, and the style where there is one.
  bool translucentSurface = false;
  std::string where; ///< a condition; empty: all points

  /// The preset that `quality` stands for; nothing where it is empty.
  /// Errors  BadArgument: `quality` is none.
  Result<std::optional<QualityPreset>> preset() const;
  /// The size counts in what closes the surface.
  bool closes() const;
  /// The same for what differs, where a technique is named and no size.
  LayerStyle sized(LayerStyle differs) const;
  /// Nothing but squares of some pixels: drawn without a style sheet.
  bool plain() const;
};

/// Colours as a representation's properties choose them.
struct LookColour
{
  std::string array; ///< empty: `flat`
  bool direct = false; ///< components are the colour
  vtkScalarsToColors* table = nullptr; ///< else; null: the array's own usual map
  std::array<double, 3> flat{ { 1.0, 1.0, 1.0 } };
};

/// A look as a style sheet. Of several components the table's vector component; a magnitude is
/// not known to style sheets, and the array's usual map takes its place.
/// `sheet` keeps what it has of classes.
/// Errors  false and why: a condition, a technique or a quality that is none.
bool applyLook(
  const PointLook& look, const LookColour& colour, StyleSheet& sheet, std::string& error);

} // namespace pointfront
