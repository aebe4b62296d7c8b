#pragma once

#include "PointLook.h"

#include "vtkNew.h"

#include <array>
#include <string>

class vtkPointFrontStyle;

namespace pointfront
{

/// A lens, as a representation's properties have it: it keeps its place in the picture, whatever
/// the picture's size.
struct LensPlace
{
  enum Shape
  {
    NONE = 0,
    CIRCLE = 1,
    RECTANGLE = 2
  };
  int shape = NONE;
  std::array<double, 2> centre{ { 0.5, 0.5 } }; ///< parts of the picture's width and height
  double radius = 0.25; ///< of a circle: part of the picture's height
  std::array<double, 2> size{ { 0.5, 0.5 } }; ///< of a rectangle: parts of width and height
};

/// Rows of a table: what differs for each class.
class ClassRows
{
public:
  ClassRows();
  ~ClassRows();
  void clear();
  /// By code, or "" for all classes where `forAll` allows it: a technique, "hidden" or ""; an
  /// attribute, "#rrggbb" or ""; pixels or "".
  void add(const std::string& code, const std::string& technique, const std::string& colour,
    const std::string& size, bool forAll = false);
  bool empty() const { return !filled_; }
  const std::string& wrong() const { return wrong_; } ///< of the last row that is; or empty
  /// What the rows say: of all classes, and of each.
  const StyleSheet& sheet() const;

private:
  bool filled_ = false;
  std::string wrong_;
  vtkNew<vtkPointFrontStyle> style_;
};

/// What a representation's properties say of the style, put together: a style sheet's file or a
/// look, what differs for each class, and a lens.
/// Threads  one.
class StyleChoice
{
public:
  StyleChoice();
  ~StyleChoice();

  PointLook look;

  /// As the process that draws sees it; read when it is needed first. Empty: none.
  void setFile(const std::string& fileName);
  ClassRows classes; ///< errors are said by `style()`
  LensPlace lens;
  ClassRows lensClasses; ///< inside the lens

  /// `width`, `height`: of the picture, pixels. Null where points are plain: then no style is
  /// needed. The same object with the same time of change as long as nothing changes. `error`:
  /// something new that is wrong; what is right counts.
  vtkPointFrontStyle* style(const LookColour& colour, int width, int height, std::string& error);

private:
  bool readFile(std::string& error);

  std::string file_;
  bool fileRead_ = false;
  std::string said_;
  vtkNew<vtkPointFrontStyle> fileStyle_;
  vtkNew<vtkPointFrontStyle> style_;
};

} // namespace pointfront
