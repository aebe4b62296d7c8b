#include "vtkPointFrontStyle.h"

#include "StyleJSON.h"

#include "pointfront/Style/ColourSource.h"
#include "pointfront/Style/StyleSheet.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{

constexpr double mostPixels = 1e6;

bool isPixels(double value)
{
  return std::abs(value) <= mostPixels;
}

} // namespace

const pointfront::StyleLens* vtkPointFrontStyle::LensOf(int lens) const
{
  const bool there = lens >= 0 && lens < this->GetNumberOfLenses();
  return there ? &this->Sheet->lenses[static_cast<std::size_t>(lens)] : nullptr;
}

int vtkPointFrontStyle::AddLens(const pointfront::StyleLens& lens)
{
  pointfront::StyleSheet sheet = *this->Sheet;
  sheet.lenses.push_back(lens);
  return this->SetStyleSheet(sheet) ? static_cast<int>(sheet.lenses.size()) - 1 : -1;
}

template <typename Change>
bool vtkPointFrontStyle::ChangeLens(int lens, const Change& change)
{
  if (!this->LensOf(lens))
  {
    vtkErrorMacro("there is no lens " << lens << "; there are " << this->GetNumberOfLenses());
    return false;
  }
  pointfront::StyleSheet sheet = *this->Sheet;
  change(sheet.lenses[static_cast<std::size_t>(lens)]);
  return this->SetStyleSheet(sheet);
}

int vtkPointFrontStyle::AddCircleLens(double x, double y, double radius)
{
  if (!isPixels(x) || !isPixels(y) || !(radius >= 0.0) || !isPixels(radius))
  {
    vtkErrorMacro("a lens lies at numbers of pixels, and its radius is not below 0; not "
      << x << ", " << y << ", " << radius);
    return -1;
  }
  pointfront::StyleLens lens;
  lens.place.shape = pointfront::LensShape::Circle;
  lens.place.centrePx = glm::vec2(x, y);
  lens.place.halfSizePx = glm::vec2(static_cast<float>(radius));
  return this->AddLens(lens);
}

int vtkPointFrontStyle::AddRectangleLens(double x, double y, double width, double height)
{
  if (!isPixels(x) || !isPixels(y) || !(width >= 0.0 && height >= 0.0) || !isPixels(width) ||
    !isPixels(height))
  {
    vtkErrorMacro("a lens lies at numbers of pixels, and its size is not below 0; not "
      << x << ", " << y << ", " << width << " x " << height);
    return -1;
  }
  pointfront::StyleLens lens;
  lens.place.shape = pointfront::LensShape::Rectangle;
  lens.place.centrePx = glm::vec2(x, y);
  lens.place.halfSizePx = glm::vec2(0.5 * width, 0.5 * height);
  return this->AddLens(lens);
}

int vtkPointFrontStyle::AddMaskLens(vtkImageData* image)
{
  int size[3] = { 0, 0, 0 };
  if (image)
  {
    image->GetDimensions(size);
  }
  if (size[0] < 1 || size[1] < 1 || size[2] != 1 || image->GetNumberOfScalarComponents() != 1)
  {
    vtkErrorMacro("a mask is an image of one slice and one component");
    return -1;
  }
  auto mask = std::make_shared<pointfront::LensMask>();
  mask->width = size[0];
  mask->height = size[1];
  const int* const extent = image->GetExtent();
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      const double value =
        image->GetScalarComponentAsDouble(extent[0] + x, extent[2] + y, extent[4], 0);
      mask->values.push_back(value != 0.0 ? 1 : 0);
    }
  }
  pointfront::StyleLens lens;
  lens.place.shape = pointfront::LensShape::Mask;
  lens.place.mask = std::move(mask);
  return this->AddLens(lens);
}

int vtkPointFrontStyle::AddClassLens(int objectClass, double radius)
{
  if (objectClass == DEFAULT_CLASS || !this->IsClass(objectClass))
  {
    vtkErrorMacro("a lens lies around the points of one class");
    return -1;
  }
  if (!(radius > 0.0) || !std::isfinite(radius))
  {
    vtkErrorMacro("the radius of a lens around a class is a number above 0, not " << radius);
    return -1;
  }
  pointfront::StyleLens lens;
  lens.place.shape = pointfront::LensShape::AroundClass;
  lens.aroundClass = static_cast<std::uint8_t>(objectClass);
  lens.aroundRadius = radius;
  return this->AddLens(lens);
}

bool vtkPointFrontStyle::SetLensStyle(int lens, const std::string& style, int objectClass)
{
  const auto parsed = pointfront::parseLayerStyle(style);
  if (!parsed)
  {
    vtkErrorMacro("style of a lens: " << parsed.error().what);
  }
  if (!this->IsClass(objectClass) || !parsed)
  {
    return false;
  }
  return this->ChangeLens(lens,
    [&](pointfront::StyleLens& changed)
    {
      (objectClass == DEFAULT_CLASS ? changed.standard
                                    : changed.classes[static_cast<std::uint8_t>(objectClass)]) =
        *parsed;
    });
}

std::string vtkPointFrontStyle::GetLensStyle(int lens, int objectClass) const
{
  const pointfront::StyleLens* const found = this->LensOf(lens);
  pointfront::LayerStyle style;
  if (found && objectClass == DEFAULT_CLASS)
  {
    style = found->standard;
  }
  else if (found && objectClass >= 0 && objectClass <= 255)
  {
    const auto own = found->classes.find(static_cast<std::uint8_t>(objectClass));
    style = own == found->classes.end() ? style : own->second;
  }
  return pointfront::writeLayerStyle(style);
}

bool vtkPointFrontStyle::SetLensCenter(int lens, double x, double y)
{
  if (!isPixels(x) || !isPixels(y))
  {
    vtkErrorMacro("a lens lies at numbers of pixels, not " << x << ", " << y);
    return false;
  }
  return this->ChangeLens(
    lens, [=](pointfront::StyleLens& changed) { changed.place.centrePx = glm::vec2(x, y); });
}

double vtkPointFrontStyle::GetLensCenterX(int lens) const
{
  const pointfront::StyleLens* const found = this->LensOf(lens);
  return found ? found->place.centrePx.x : 0.0;
}

double vtkPointFrontStyle::GetLensCenterY(int lens) const
{
  const pointfront::StyleLens* const found = this->LensOf(lens);
  return found ? found->place.centrePx.y : 0.0;
}

bool vtkPointFrontStyle::SetLensRadius(int lens, double radius)
{
  if (!(radius >= 0.0) || !isPixels(radius))
  {
    vtkErrorMacro("a radius is a number of pixels, not " << radius);
    return false;
  }
  const pointfront::StyleLens* const found = this->LensOf(lens);
  if (found && found->place.shape != pointfront::LensShape::Circle)
  {
    vtkErrorMacro("lens " << lens << " is no circle");
    return false;
  }
  const glm::vec2 half(static_cast<float>(radius));
  return this->ChangeLens(
    lens, [half](pointfront::StyleLens& changed) { changed.place.halfSizePx = half; });
}

double vtkPointFrontStyle::GetLensRadius(int lens) const
{
  const pointfront::StyleLens* const found = this->LensOf(lens);
  return found && found->place.shape == pointfront::LensShape::Circle ? found->place.halfSizePx.x
                                                                      : 0.0;
}

int vtkPointFrontStyle::GetNumberOfLenses() const
{
  return static_cast<int>(this->Sheet->lenses.size());
}

bool vtkPointFrontStyle::RemoveLens(int lens)
{
  if (!this->LensOf(lens))
  {
    vtkErrorMacro("there is no lens " << lens << "; there are " << this->GetNumberOfLenses());
    return false;
  }
  pointfront::StyleSheet sheet = *this->Sheet;
  sheet.lenses.erase(sheet.lenses.begin() + lens);
  return this->SetStyleSheet(sheet);
}

void vtkPointFrontStyle::RemoveAllLenses()
{
  pointfront::StyleSheet sheet = *this->Sheet;
  sheet.lenses.clear();
  this->SetStyleSheet(sheet);
}

bool vtkPointFrontStyle::SetHighlight(
  int objectClass, const std::string& color, double haloPx, double tint)
{
  const auto colour = pointfront::parseColourCode(color);
  if (objectClass == DEFAULT_CLASS || !this->IsClass(objectClass) || !colour ||
    !(haloPx >= 0.0 && haloPx <= pointfront::mostHaloPx) || !(tint >= 0.0 && tint <= 1.0))
  {
    vtkErrorMacro("a highlight has a class from 0 to 255, a colour \"#rrggbb\", a rim of 0 to "
      << pointfront::mostHaloPx << " pixels and a tint from 0 to 1");
    return false;
  }
  pointfront::StyleSheet sheet = *this->Sheet;
  pointfront::StyleHighlight highlight;
  highlight.objectClass = static_cast<std::uint8_t>(objectClass);
  highlight.colour = *colour;
  highlight.haloPx = static_cast<float>(haloPx);
  highlight.tint = static_cast<float>(tint);
  const auto same = std::find_if(sheet.highlights.begin(), sheet.highlights.end(),
    [&](const auto& one) { return one.objectClass == highlight.objectClass; });
  if (same != sheet.highlights.end())
  {
    *same = highlight;
  }
  else if (sheet.highlights.size() < pointfront::mostHighlights)
  {
    sheet.highlights.push_back(highlight);
  }
  else
  {
    vtkErrorMacro("at most " << pointfront::mostHighlights << " classes are highlighted at once");
    return false;
  }
  return this->SetStyleSheet(sheet);
}

bool vtkPointFrontStyle::HasHighlight(int objectClass) const
{
  const auto& all = this->Sheet->highlights;
  return std::any_of(
    all.begin(), all.end(), [&](const auto& one) { return one.objectClass == objectClass; });
}

bool vtkPointFrontStyle::RemoveHighlight(int objectClass)
{
  pointfront::StyleSheet sheet = *this->Sheet;
  auto& all = sheet.highlights;
  const auto gone = std::remove_if(
    all.begin(), all.end(), [&](const auto& one) { return one.objectClass == objectClass; });
  if (gone == all.end())
  {
    return false;
  }
  all.erase(gone, all.end());
  return this->SetStyleSheet(sheet);
}
