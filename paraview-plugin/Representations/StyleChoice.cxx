#include "StyleChoice.h"

#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include "vtkPointFrontStyle.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iterator>

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

/// A lens in a picture of some size, with the styles inside it.
StyleLens lensIn(const LensPlace& place, const ClassRows& inside, int width, int height)
{
  const double size[2] = { static_cast<double>(width), static_cast<double>(height) };
  StyleLens lens;
  lens.place.shape = place.shape == LensPlace::CIRCLE ? LensShape::Circle : LensShape::Rectangle;
  for (int axis = 0; axis < 2; ++axis)
  {
    const auto at = static_cast<std::size_t>(axis);
    const double half =
      place.shape == LensPlace::CIRCLE ? place.radius * size[1] : 0.5 * place.size[at] * size[axis];
    lens.place.centrePx[axis] = static_cast<float>(place.centre[at] * size[axis]);
    lens.place.halfSizePx[axis] = static_cast<float>(std::max(half, 0.0));
  }
  lens.standard = inside.sheet().standard;
  lens.classes = inside.sheet().classes;
  return lens;
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
  char* end = nullptr;
  const double pixels = std::strtod(size.c_str(), &end);
  const bool known = technique.empty() || technique == "hidden" || techniqueOf(technique);
  if ((number < 0 && !all) || !known || *end != '\0' || (!size.empty() && !(pixels > 0.0)))
  {
    wrong_ = "the class style \"" + code + "\", \"" + technique + "\", \"" + colour + "\", \"" +
      size + "\" is none: a code of 0 to 255, hidden or one of " + techniqueList() +
      ", a colour, a size above 0";
    return;
  }
  filled_ = true;
  bool right = true;
  if (technique == "hidden")
  {
    right = style_->SetVisibility(false, number);
  }
  else if (!technique.empty())
  {
    right = style_->SetTechnique(technique, number);
  }
  right = (colour.empty() || style_->SetColor(colour, number)) && right;
  right = (size.empty() || style_->SetSizePixels(pixels, number)) && right;
  static_cast<void>(right); // the style itself has said what is wrong
}

StyleChoice::StyleChoice() = default;

StyleChoice::~StyleChoice() = default;

void StyleChoice::setFile(const std::string& fileName)
{
  if (file_ != fileName)
  {
    file_ = fileName;
    fileRead_ = false;
  }
}

bool StyleChoice::readFile(std::string& error)
{
  if (!fileRead_)
  {
    fileRead_ = true;
    fileStyle_->Reset();
    std::ifstream file(file_);
    const std::string text{ std::istreambuf_iterator<char>(file),
      std::istreambuf_iterator<char>() };
    if (!file && text.empty())
    {
      error = file_ + ": the style sheet cannot be read";
    }
    else
    {
      fileStyle_->LoadJSON(text); // says itself what is wrong
    }
  }
  return error.empty();
}

vtkPointFrontStyle* StyleChoice::style(
  const LookColour& colour, int width, int height, std::string& error)
{
  const bool seesThroughLens = lens.shape != LensPlace::NONE && !lensClasses.empty();
  std::string wrong = classes.wrong().empty() ? lensClasses.wrong() : classes.wrong();
  StyleSheet sheet;
  bool needed = !classes.empty() || seesThroughLens || !file_.empty() || !look.plain();
  if (!file_.empty())
  {
    if (readFile(wrong))
    {
      sheet = fileStyle_->GetStyleSheet();
    }
  }
  else if (needed && !applyLook(look, colour, sheet, wrong))
  {
    needed = false;
  }
  for (const auto& [number, differs] : classes.sheet().classes)
  {
    LayerStyle& own = sheet.classes[number];
    own = differs.over(own);
  }
  if (seesThroughLens)
  {
    sheet.lenses.push_back(lensIn(lens, lensClasses, width, height));
  }
  error = wrong == said_ ? std::string() : wrong;
  said_ = wrong;
  if (!needed)
  {
    return nullptr;
  }
  style_->SetStyleSheet(sheet);
  return style_;
}

} // namespace pointfront
