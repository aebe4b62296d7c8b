#pragma once

#include <glm/vec2.hpp>

#include <vtkNew.h>
#include <vtkTextActor.h>

#include <string>

class vtkCallbackCommand;
class vtkRenderer;

namespace pointfront
{

/// Lines of text over a corner of the picture. Empty text is no panel. Text that the picture has no
/// room for is written smaller.
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
  ~TextPanel();
  TextPanel(const TextPanel&) = delete;
  TextPanel& operator=(const TextPanel&) = delete;

  /// True if the text is another one than before.
  bool set(const std::string& text);
  const std::string& text() const { return text_; }
  /// Hidden text stays.
  void setVisible(bool visible);

private:
  void fit();

  vtkRenderer* renderer_;
  vtkNew<vtkCallbackCommand> command_;
  vtkNew<vtkTextActor> actor_;
  glm::ivec2 fitted_{ 0, 0 }; ///< size in pixels of the view that the text fits; 0: of none yet
  std::string text_;
  bool visible_ = true;
};

} // namespace pointfront
