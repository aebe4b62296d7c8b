#include "ClassRows.h"

#include "PointLook.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include "vtkPointFrontStyle.h"

#include <cstdlib>
#include <optional>
#include <string_view>

namespace pointfront
{
namespace
{

/// A whole number of 0 to 255, else -1.
int classOf(const std::string& code)
{
  char* end = nullptr;
  const long number = std::strtol(code.c_str(), &end, 10);
  return !code.empty() && *end == '\0' && number >= 0 && number <= 255 ? static_cast<int>(number)
                                                                       : -1;
}

/// From 0 on, which an empty text is; nothing: the text is no such number.
std::optional<double> numberOf(const std::string& text, double most)
{
  std::string_view rest(text);
  const double number = text.empty() ? 0.0 : takeNumber(rest);
  return rest.empty() && number >= 0.0 && number <= most ? std::optional<double>(number)
                                                         : std::nullopt;
}

} // namespace

ClassRows::ClassRows() = default;

ClassRows::~ClassRows() = default;

void ClassRows::clear()
{
  style_->Reset();
  filled_ = false;
  wrong_.clear();
}

const StyleSheet& ClassRows::sheet() const
{
  return style_->GetStyleSheet();
}

void ClassRows::add(const std::string& code, const std::string& technique,
  const std::string& colour, const std::string& size, bool forAll)
{
  const bool all = forAll && code.empty();
  const int number = all ? vtkPointFrontStyle::DEFAULT_CLASS : classOf(code);
  if (code.empty() && technique.empty() && colour.empty() && size.empty())
  {
    return; // a row that is not filled in yet
  }
  std::string_view rest(size);
  const double pixels = takeNumber(rest);
  const bool known =
    technique.empty() || technique == "hidden" || namedTechnique(technique).has_value();
  if ((number < 0 && !all) || !known || !rest.empty() || (!size.empty() && !(pixels > 0.0)))
  {
    wrong_ = "the class style \"" + code + "\", \"" + technique + "\", \"" + colour + "\", \"" +
      size + "\" is none: a code of 0 to 255, hidden or one of " + namedTechniques() +
      ", a colour, a size above 0";
    return;
  }
  filled_ = true;
  bool right = true;
  if (technique == "hidden")
  {
    right = style_->SetVisibility(false, number);
  }
  else if (const auto named = namedTechnique(technique))
  {
    right = style_->SetTechnique(traitsOf(named->technique).name, number) &&
      (!named->blended || style_->SetBlended(*named->blended, number));
  }
  right = (colour.empty() || style_->SetColor(colour, number)) && right;
  right = (size.empty() || style_->SetSizePixels(pixels, number)) && right;
  static_cast<void>(right); // the style itself has said what is wrong
}

void ClassRows::addLight(
  const std::string& code, const std::string& light, const std::string& eyeDomeStrength)
{
  if (code.empty() && light.empty() && eyeDomeStrength.empty())
  {
    return; // a row that is not filled in yet
  }
  const int number = classOf(code);
  const bool word = light.empty() || light == "on" || light == "off";
  const std::optional<double> ambient = word ? 0.0 : numberOf(light, mostLight);
  const std::optional<double> strength =
    eyeDomeStrength.empty() ? 0.0 : numberOf(eyeDomeStrength, mostEyeDomeStrength);
  if (number < 0 || !ambient || !strength)
  {
    wrong_ = "the light of a class \"" + code + "\", \"" + light + "\", \"" + eyeDomeStrength +
      "\" is none: a code of 0 to 255; on, off or a number of 0 to 10; a number of 0 to 100";
    return;
  }
  filled_ = true;
  if (!light.empty())
  {
    style_->SetLit(light != "off", number);
  }
  if (!word)
  {
    style_->SetAmbient(*ambient, number);
  }
  if (!eyeDomeStrength.empty())
  {
    style_->SetEyeDomeStrength(*strength, number);
  }
}

} // namespace pointfront
