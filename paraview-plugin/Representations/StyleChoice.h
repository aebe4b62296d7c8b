#pragma once

#include "ClassRows.h"
#include "LensChoice.h"
#include "PointLook.h"

#include "vtkNew.h"

#include <string>

class vtkPointFrontStyle;

namespace pointfront
{

/// Puts the style together from a representation's properties: a style sheet's file or a
/// look, what differs for each class, and a lens.
/// Threads  one.
class StyleChoice
{
public:
  StyleChoice();
  ~StyleChoice();

  PointLook look;

  /// As the process that draws sees it; read when it is needed first. Empty: none. One that cannot
  /// be read counts for nothing.
  void setFile(const std::string& fileName);
  ClassRows classes; ///< errors are said by `style()`
  ClassRows lights; ///< lights of classes
  LensChoice lens;

  /// `width`, `height`: of the picture, pixels. Null where points are plain: then no style is
  /// needed. The same object with the same time of change as long as nothing changes. `error`:
  /// something new that is wrong; what is right counts.
  vtkPointFrontStyle* style(const LookColour& colour, int width, int height, std::string& error);

private:
  /// Whether the file says how points look; where nothing else is wrong, `error` is what is wrong
  /// with it.
  bool readFile(std::string& error);

  std::string file_;
  bool fileRead_ = false;
  bool fileCounts_ = false;
  std::string fileError_;
  std::string said_;
  vtkNew<vtkPointFrontStyle> fileStyle_;
  vtkNew<vtkPointFrontStyle> style_;
};

} // namespace pointfront
