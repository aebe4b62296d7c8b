#include "TextPanel.h"

#include <vtkCoordinate.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace pointfront
{

namespace
{
constexpr int fontSize = 15;
constexpr double margin = 0.012; // share of the view
constexpr double dim = 0.65; // opacity behind the text
} // namespace

TextPanel::TextPanel(vtkRenderer* renderer, Corner corner)
{
  vtkTextProperty* const look = actor_->GetTextProperty();
  look->SetFontFamilyToCourier();
  look->SetFontSize(fontSize);
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
}

bool TextPanel::set(const std::string& text)
{
  if (text == text_)
  {
    return false;
  }
  text_ = text;
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
