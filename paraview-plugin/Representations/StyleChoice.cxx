#include "StyleChoice.h"

#include "pointfront/Style/StyleSheet.h"

#include "vtkPointFrontStyle.h"

#include <fstream>
#include <iterator>
#include <utility>

namespace pointfront
{

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
    const bool missing = !file && text.empty();
    fileError_ = missing ? file_ + ": the style sheet cannot be read" : std::string();
    fileCounts_ = !missing && fileStyle_->LoadJSON(text); // says itself what is wrong
  }
  error = error.empty() ? fileError_ : error;
  return fileCounts_;
}

vtkPointFrontStyle* StyleChoice::style(
  const LookColour& colour, int width, int height, std::string& error)
{
  std::string wrong;
  for (const ClassRows* rows : { &classes, &lights, &lens.classes })
  {
    wrong = wrong.empty() ? rows->wrong() : wrong;
  }
  StyleSheet sheet;
  const bool byFile = !file_.empty() && readFile(wrong);
  bool needed = !classes.empty() || !lights.empty() || lens.shows() || byFile || !look.plain();
  if (byFile)
  {
    sheet = fileStyle_->GetStyleSheet();
  }
  else if (needed && !applyLook(look, colour, sheet, wrong))
  {
    needed = false;
  }
  // A file says how large its points are.
  const auto sized = [&](const LayerStyle& differs)
  { return byFile ? differs : look.sized(differs); };
  for (const auto& [number, differs] : classes.sheet().classes)
  {
    LayerStyle& own = sheet.classes[number];
    own = sized(differs).over(own);
  }
  for (const auto& [number, differs] : lights.sheet().classes)
  {
    LayerStyle& own = sheet.classes[number];
    own = differs.over(own);
  }
  if (auto seen = lens.lens(width, height, wrong))
  {
    seen->standard = sized(seen->standard);
    for (auto& [number, differs] : seen->classes)
    {
      differs = sized(differs);
    }
    sheet.lenses.push_back(std::move(*seen));
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
