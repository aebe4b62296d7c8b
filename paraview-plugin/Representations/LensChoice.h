#pragma once

#include "ClassRows.h"

#include "pointfront/Style/StyleLens.h"

#include "vtkNew.h"

#include <array>
#include <optional>
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
    RECTANGLE = 2,
    MASK = 3, ///< mask in an image file
    AROUND_CLASS = 4 ///< discs around the points of a class
  };
  int shape = NONE;
  std::array<double, 2> centre{ { 0.5, 0.5 } }; ///< parts of the picture's width and height
  double radius = 0.25; ///< radius of a circle: part of the picture's height
  std::array<double, 2> size{ { 0.5, 0.5 } }; ///< size of a rectangle: parts of width and height
  int aroundClass = 6;
  double aroundRadius = 2.0; ///< radius of a disc around a point, units of the coordinates
};

/// A lens and what is drawn inside it.
/// Threads  one.
class LensChoice
{
public:
  LensChoice();
  ~LensChoice();

  LensPlace place;
  ClassRows classes; ///< inside

  /// An image, as the process that draws sees it: the lens covers what is not black in it.
  void setMaskFile(const std::string& fileName);

  /// Whether there is a lens, and it shows anything else than the picture around it.
  bool shows() const { return place.shape != LensPlace::NONE && !classes.empty(); }
  /// In a picture of that size, pixels. Nothing where there is none, or `error` says what is wrong.
  std::optional<StyleLens> lens(int width, int height, std::string& error);

private:
  bool readMask(std::string& error);

  std::string maskFile_;
  bool maskRead_ = false;
  FrameLens mask_;
};

} // namespace pointfront
