#pragma once

#include <array>
#include <string>

class vtkScalarsToColors;

namespace pointfront
{

struct StyleSheet;

/// How a representation's properties say that points look: what ParaView's own properties cannot.
/// Threads  a value.
struct PointLook
{
  std::string technique = "points"; ///< as style sheets name it
  bool closing = false; ///< size: what closes the surface times `size`, else pixels
  double size = 2.0; ///< > 0
  double eyeDomeStrength = 0.0; ///< 0: off
  std::string quality; ///< a preset, in the place of technique and closing; empty: none
  bool lit = false;
  bool fillHoles = false;
  double opacity = 1.0;
  std::string where; ///< a condition; empty: all points

  /// The size counts in what closes the surface.
  bool closes() const { return closing || !quality.empty(); }
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
