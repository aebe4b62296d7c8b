#include "TextPanel.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace pointfront
{

namespace
{
constexpr int fontSize = 15;
constexpr int leastFontSize = 6; // smaller letters are no letters
constexpr double margin = 0.012; // share of the view
constexpr double dim = 0.65; // opacity behind the text
} // namespace

TextPanel::TextPanel(vtkRenderer* renderer, Corner corner)
  : renderer_(renderer)
{
  vtkTextProperty* const look = actor_->GetTextProperty();
  look->SetFontFamilyToCourier();
  look->SetColor(1.0, 1.0, 1.0);
  look->SetBackgroundColor(0.0, 0.0, 0.0);
  look->SetBackgroundOpacity(dim);
  actor_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  const bool right = corner == Corner::UpperRight;
  const bool low = corner == Corner::LowerLeft;
  actor_->SetPosition(right ? 1.0 - margin : margin, low ? margin : 1.0 - margin);
  right ? look->SetJustificationToRight() : look->SetJustificationToLeft();
  low ? look->SetVerticalJustificationToBottom() : look->SetVerticalJustificationToTop();
  actor_->PickableOff();
  actor_->VisibilityOff();
  renderer->AddViewProp(actor_);
  command_->SetClientData(this);
  command_->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*) { static_cast<TextPanel*>(self)->fit(); });
  renderer->AddObserver(vtkCommand::StartEvent, command_);
}

TextPanel::~TextPanel()
{
  renderer_->RemoveObserver(command_);
}

void TextPanel::fit()
{
  const int* const size = renderer_->GetSize();
  const glm::ivec2 view(size[0], size[1]);
  if (text_.empty() || view == fitted_)
  {
    return;
  }
  fitted_ = view;
  vtkTextProperty* const look = actor_->GetTextProperty();
  const glm::dvec2 room = (1.0 - 2.0 * margin) * glm::dvec2(view);
  for (int font = fontSize; font >= leastFontSize; --font)
  {
    double taken[2];
    look->SetFontSize(font);
    actor_->GetSize(renderer_, taken);
    if (taken[0] <= room.x && taken[1] <= room.y)
    {
      return;
    }
  }
}

bool TextPanel::set(const std::string& text)
{
  if (text == text_)
  {
    return false;
  }
  text_ = text;
  fitted_ = glm::ivec2(0);
  actor_->SetInput(text_.c_str());
  setVisible(visible_);
  return true;
}

void TextPanel::setVisible(bool visible)
{
  visible_ = visible;
  actor_->SetVisibility(visible && !text_.empty() ? 1 : 0);
}

} // namespace pointfront
