#pragma once

#include "PointLook.h"

#include "vtkNew.h"

#include <string>

class vtkPointFrontStyle;

namespace pointfront
{

/// What a representation's properties say of the style, put together: a style sheet's file or a
/// look, and what differs for each class.
/// Threads  one.
class StyleChoice
{
public:
  StyleChoice();
  ~StyleChoice();

  PointLook look;

  /// As the process that draws sees it; read when it is needed first. Empty: none.
  void setFile(const std::string& fileName);
  void clearClasses();
  /// By code: a technique, "hidden" or ""; an attribute, "#rrggbb" or ""; pixels or "". Errors are
  /// said by `style()`.
  void addClass(const std::string& code, const std::string& technique, const std::string& colour,
    const std::string& size);

  /// Null where points are plain: then no style is needed. The same object with the same time of
  /// change as long as nothing changes. `error`: something new that is wrong; what is right counts.
  vtkPointFrontStyle* style(const LookColour& colour, std::string& error);

private:
  bool readFile(std::string& error);

  std::string file_;
  bool fileRead_ = false;
  bool classes_ = false;
  std::string wrongClass_;
  std::string said_;
  vtkNew<vtkPointFrontStyle> fileStyle_;
  vtkNew<vtkPointFrontStyle> classStyle_;
  vtkNew<vtkPointFrontStyle> style_;
};

} // namespace pointfront
