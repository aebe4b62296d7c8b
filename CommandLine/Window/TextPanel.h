#pragma once

#include <vtkNew.h>
#include <vtkTextActor.h>

#include <string>

class vtkRenderer;

namespace pointfront
{

/// Lines of text over a corner of the picture. Empty text is no panel.
class TextPanel
{
public:
  enum class Corner
  {
    UpperLeft,
    UpperRight,
    LowerLeft
  };
  TextPanel(vtkRenderer* renderer, Corner corner);

  /// True if the text is another one than before.
  bool set(const std::string& text);
  const std::string& text() const { return text_; }
  /// Hidden text stays.
  void setVisible(bool visible);

private:
  vtkNew<vtkTextActor> actor_;
  std::string text_;
  bool visible_ = true;
};

} // namespace pointfront
