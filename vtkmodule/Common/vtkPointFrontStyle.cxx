#include "vtkPointFrontStyle.h"

#include "StyleJSON.h"

#include "pointfront/Quality/QualityChoice.h"
#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include <vtkIndent.h>
#include <vtkObjectFactory.h>

#include <sstream>

vtkStandardNewMacro(vtkPointFrontStyle);

namespace
{

std::string placeOf(int objectClass)
{
  return objectClass == vtkPointFrontStyle::DEFAULT_CLASS ? "default"
                                                          : "class " + std::to_string(objectClass);
}

/// A text as JSON has it.
std::string quoted(const std::string& text)
{
  std::ostringstream out;
  out << '"';
  for (const char c : text)
  {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
    {
      out << '\\' << c;
    }
    else if (code < 0x20)
    {
      constexpr const char* digits = "0123456789abcdef";
      out << "\\u00" << digits[code / 16] << digits[code % 16];
    }
    else
    {
      out << c;
    }
  }
  out << '"';
  return out.str();
}

} // namespace

vtkPointFrontStyle::vtkPointFrontStyle()
  : Sheet(std::make_shared<const pointfront::StyleSheet>())
{
}

vtkPointFrontStyle::~vtkPointFrontStyle() = default;

bool vtkPointFrontStyle::IsClass(int objectClass)
{
  if (objectClass < DEFAULT_CLASS || objectClass > 255)
  {
    vtkErrorMacro("a class is a code from 0 to 255, not " << objectClass);
    return false;
  }
  return true;
}

pointfront::LayerStyle vtkPointFrontStyle::StyleOf(int objectClass) const
{
  return objectClass >= 0 && objectClass <= 255
    ? this->Sheet->styleOf(static_cast<std::uint8_t>(objectClass))
    : this->Sheet->standard.over(pointfront::standardStyle());
}

template <typename Change>
bool vtkPointFrontStyle::ChangeStyle(int objectClass, const Change& change)
{
  if (!this->IsClass(objectClass))
  {
    return false;
  }
  pointfront::StyleSheet sheet = *this->Sheet;
  change(objectClass == DEFAULT_CLASS ? sheet.standard
                                      : sheet.classes[static_cast<std::uint8_t>(objectClass)]);
  return this->SetStyleSheet(sheet);
}

/// Through the reader of styles, which knows what is right and says what is wrong.
bool vtkPointFrontStyle::ChangeByJSON(
  int objectClass, const std::string& key, const std::string& json)
{
  const auto parsed =
    pointfront::parseStyleSheet("{\"default\": {" + quoted(key) + ": " + json + "}}");
  if (!parsed)
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": " << parsed.error().what);
    return false;
  }
  pointfront::LayerStyle others = parsed->standard;
  (key == "color"      ? others.colour.reset()
      : key == "where" ? others.where.reset()
                       : others.technique.reset());
  if (!others.empty())
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": expected a value for " << key << " alone");
    return false;
  }
  return this->ChangeStyle(objectClass,
    [&parsed](pointfront::LayerStyle& style) { style = parsed->standard.over(style); });
}

bool vtkPointFrontStyle::SetTechnique(const std::string& name, int objectClass)
{
  return this->ChangeByJSON(objectClass, "technique", quoted(name));
}

std::string vtkPointFrontStyle::GetTechnique(int objectClass) const
{
  return pointfront::traitsOf(*this->StyleOf(objectClass).technique).name;
}

bool vtkPointFrontStyle::SetQuality(const std::string& name, int objectClass)
{
  const pointfront::Result<pointfront::QualityChoice> choice = pointfront::chooseQuality(name);
  if (!choice)
  {
    vtkErrorMacro(<< choice.error().what);
    return false;
  }
  return this->ChangeStyle(
    objectClass, [&choice](pointfront::LayerStyle& style) { choice->preset.applyTo(style); });
}

bool vtkPointFrontStyle::SetColor(const std::string& color, int objectClass)
{
  const std::size_t first = color.find_first_not_of(" \t\r\n");
  const bool object = first != std::string::npos && color[first] == '{';
  return this->ChangeByJSON(objectClass, "color", object ? color : quoted(color));
}

std::string vtkPointFrontStyle::GetColor(int objectClass) const
{
  return pointfront::writeColour(*this->StyleOf(objectClass).colour);
}

namespace
{
auto sizeSetter(pointfront::SplatSize::Mode mode, double value, const std::string& attribute = "")
{
  return [=](pointfront::LayerStyle& style) {
    style.size = pointfront::StyleSize{ mode, value, attribute };
  };
}
} // namespace

bool vtkPointFrontStyle::SetSizePixels(double diameter, int objectClass)
{
  if (!(diameter > 0.0))
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": a size is a number above 0, not " << diameter);
    return false;
  }
  return this->ChangeStyle(objectClass, sizeSetter(pointfront::SplatSize::Mode::Pixels, diameter));
}

bool vtkPointFrontStyle::SetSizeWorld(double diameter, int objectClass)
{
  if (!(diameter > 0.0))
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": a size is a number above 0, not " << diameter);
    return false;
  }
  return this->ChangeStyle(objectClass, sizeSetter(pointfront::SplatSize::Mode::World, diameter));
}

bool vtkPointFrontStyle::SetSizeSpacing(double factor, int objectClass)
{
  if (!(factor > 0.0))
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": a factor is a number above 0, not " << factor);
    return false;
  }
  return this->ChangeStyle(objectClass, sizeSetter(pointfront::SplatSize::Mode::Spacing, factor));
}

bool vtkPointFrontStyle::SetSizeAttribute(
  const std::string& attribute, double factor, int objectClass)
{
  if (!(factor > 0.0))
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": a factor is a number above 0, not " << factor);
    return false;
  }
  return this->ChangeStyle(
    objectClass, sizeSetter(pointfront::SplatSize::Mode::Attribute, factor, attribute));
}

std::string vtkPointFrontStyle::GetSize(int objectClass) const
{
  return pointfront::writeSize(*this->StyleOf(objectClass).size);
}

bool vtkPointFrontStyle::SetRimColor(const std::string& color, int objectClass)
{
  const std::optional<pointfront::Rgba8> rim = pointfront::parseColourCode(color);
  if (!rim)
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": '" << color << "' is no colour; use #rrggbb");
    return false;
  }
  return this->ChangeStyle(
    objectClass, [&rim](pointfront::LayerStyle& style) { style.rim = *rim; });
}

std::string vtkPointFrontStyle::GetRimColor(int objectClass) const
{
  return pointfront::colourCode(*this->StyleOf(objectClass).rim);
}

bool vtkPointFrontStyle::SetWallColor(
  const std::string& upper, const std::string& lower, int objectClass)
{
  const std::optional<pointfront::Rgba8> from = pointfront::parseColourCode(upper);
  const std::optional<pointfront::Rgba8> to = pointfront::parseColourCode(lower);
  const bool none = upper.empty() && lower.empty();
  if (!none && (!from || !to))
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": '" << (from ? lower : upper)
                  << "' is no colour; use #rrggbb for both ends of a wall, or nothing");
    return false;
  }
  return this->ChangeStyle(objectClass,
    [&](pointfront::LayerStyle& style)
    {
      style.wall.reset();
      if (!none)
      {
        style.wall = { *from, *to };
      }
    });
}

std::string vtkPointFrontStyle::GetWallColorUpper(int objectClass) const
{
  const auto wall = this->StyleOf(objectClass).wall;
  return wall ? pointfront::colourCode((*wall)[0]) : std::string();
}

std::string vtkPointFrontStyle::GetWallColorLower(int objectClass) const
{
  const auto wall = this->StyleOf(objectClass).wall;
  return wall ? pointfront::colourCode((*wall)[1]) : std::string();
}

bool vtkPointFrontStyle::SetVisibility(bool visible, int objectClass)
{
  return this->ChangeStyle(
    objectClass, [visible](pointfront::LayerStyle& style) { style.visible = visible; });
}

bool vtkPointFrontStyle::GetVisibility(int objectClass) const
{
  return *this->StyleOf(objectClass).visible;
}

bool vtkPointFrontStyle::SetOpacity(double opacity, int objectClass)
{
  if (!(opacity >= 0.0 && opacity <= 1.0))
  {
    vtkErrorMacro(<< placeOf(objectClass) << ": an opacity is from 0 to 1, not " << opacity);
    return false;
  }
  return this->ChangeStyle(
    objectClass, [opacity](pointfront::LayerStyle& style) { style.opacity = opacity; });
}

double vtkPointFrontStyle::GetOpacity(int objectClass) const
{
  return *this->StyleOf(objectClass).opacity;
}

bool vtkPointFrontStyle::SetBlended(bool blended, int objectClass)
{
  return this->ChangeStyle(
    objectClass, [blended](pointfront::LayerStyle& style) { style.blended = blended; });
}

bool vtkPointFrontStyle::GetBlended(int objectClass) const
{
  return *this->StyleOf(objectClass).blended;
}

bool vtkPointFrontStyle::SetFilter(const std::string& where, int objectClass)
{
  return this->ChangeByJSON(objectClass, "where", quoted(where));
}

std::string vtkPointFrontStyle::GetFilter(int objectClass) const
{
  return this->StyleOf(objectClass).where->text;
}

bool vtkPointFrontStyle::SetEpoch(const std::string& epoch, int objectClass)
{
  return this->ChangeStyle(
    objectClass, [&epoch](pointfront::LayerStyle& style) { style.epoch = epoch; });
}

bool vtkPointFrontStyle::ShowAllEpochs(int objectClass)
{
  return this->ChangeStyle(objectClass, [](pointfront::LayerStyle& style) { style.epoch.reset(); });
}

std::string vtkPointFrontStyle::GetEpoch(int objectClass) const
{
  return this->StyleOf(objectClass).epoch.value_or(std::string());
}

bool vtkPointFrontStyle::SetCommonFilter(const std::string& where)
{
  const auto filter = pointfront::FilterExpression::parse(where);
  if (!filter)
  {
    vtkErrorMacro(<< filter.error().what);
    return false;
  }
  pointfront::StyleSheet sheet = *this->Sheet;
  sheet.where = *filter;
  return this->SetStyleSheet(sheet);
}

std::string vtkPointFrontStyle::GetCommonFilter() const
{
  return this->Sheet->where.text;
}

bool vtkPointFrontStyle::SetFillHoles(bool fill)
{
  pointfront::StyleSheet sheet = *this->Sheet;
  sheet.shading.fillHoles = fill;
  return this->SetStyleSheet(sheet);
}

bool vtkPointFrontStyle::GetFillHoles() const
{
  return this->Sheet->shading.fillHoles;
}

void vtkPointFrontStyle::ResetClass(int objectClass)
{
  if (objectClass == DEFAULT_CLASS || !this->IsClass(objectClass))
  {
    return;
  }
  pointfront::StyleSheet sheet = *this->Sheet;
  sheet.classes.erase(static_cast<std::uint8_t>(objectClass));
  this->SetStyleSheet(sheet);
}

void vtkPointFrontStyle::Reset()
{
  this->SetStyleSheet(pointfront::StyleSheet());
}

bool vtkPointFrontStyle::LoadJSON(const std::string& text)
{
  const auto sheet = pointfront::parseStyleSheet(text);
  if (!sheet)
  {
    vtkErrorMacro(<< sheet.error().what);
    return false;
  }
  return this->SetStyleSheet(*sheet);
}

std::string vtkPointFrontStyle::SaveJSON() const
{
  return pointfront::writeStyleSheet(*this->Sheet);
}

const pointfront::StyleSheet& vtkPointFrontStyle::GetStyleSheet() const
{
  return *this->Sheet;
}

bool vtkPointFrontStyle::SetStyleSheet(const pointfront::StyleSheet& sheet)
{
  if (sheet != *this->Sheet)
  {
    this->Sheet = std::make_shared<const pointfront::StyleSheet>(sheet);
    this->Modified();
  }
  return true;
}

void vtkPointFrontStyle::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Style: " << this->SaveJSON() << "\n";
}
