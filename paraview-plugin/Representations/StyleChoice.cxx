#include "StyleChoice.h"

#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include "vtkPointFrontStyle.h"

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

} // namespace

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

void StyleChoice::clearClasses()
{
  classStyle_->Reset();
  classes_ = false;
  wrongClass_.clear();
}

void StyleChoice::addClass(const std::string& code, const std::string& technique,
  const std::string& colour, const std::string& size)
{
  const int number = classOf(code);
  if (code.empty() && technique.empty() && colour.empty() && size.empty())
  {
    return; // a row that is not filled in yet
  }
  char* end = nullptr;
  const double pixels = std::strtod(size.c_str(), &end);
  const bool known = technique.empty() || technique == "hidden" || techniqueOf(technique);
  if (number < 0 || !known || *end != '\0' || (!size.empty() && !(pixels > 0.0)))
  {
    wrongClass_ = "the class style \"" + code + "\", \"" + technique + "\", \"" + colour +
      "\", \"" + size + "\" is none: a code of 0 to 255, hidden or one of " + techniqueList() +
      ", a colour, a size above 0";
    return;
  }
  classes_ = true;
  bool right = true;
  if (technique == "hidden")
  {
    right = classStyle_->SetVisibility(false, number);
  }
  else if (!technique.empty())
  {
    right = classStyle_->SetTechnique(technique, number);
  }
  right = (colour.empty() || classStyle_->SetColor(colour, number)) && right;
  right = (size.empty() || classStyle_->SetSizePixels(pixels, number)) && right;
  static_cast<void>(right); // the style itself has said what is wrong
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

vtkPointFrontStyle* StyleChoice::style(const LookColour& colour, std::string& error)
{
  std::string wrong = wrongClass_;
  StyleSheet sheet;
  bool needed = classes_ || !file_.empty() || !look.plain();
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
  for (const auto& [number, differs] : classStyle_->GetStyleSheet().classes)
  {
    LayerStyle& own = sheet.classes[number];
    own = differs.over(own);
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
