#include "Appearance.h"

#include "MappedStores.h"

#include "vtkPointFrontMapper.h"

#include <utility>

namespace pointfront
{

namespace
{
int backendOf(DrawingBackend backend)
{
  switch (backend)
  {
    case DrawingBackend::Software:
      return vtkPointFrontMapper::SOFTWARE;
    case DrawingBackend::OpenGL:
      return vtkPointFrontMapper::OPENGL;
    case DrawingBackend::Auto:
      break;
  }
  return vtkPointFrontMapper::AUTOMATIC;
}
} // namespace

Appearance::Appearance(vtkRenderer* renderer, MappedStores& stores)
  : renderer_(renderer)
  , stores_(stores)
{
}

Result<void> Appearance::draw(const Looks& looks)
{
  const DrawingOptions& drawing = looks.drawing();
  Result<void> shown = stores_.show(drawing, backendOf(drawing.backend), renderer_);
  if (shown)
  {
    looks_ = looks;
  }
  return shown;
}

Result<void> Appearance::open(const DrawingOptions& drawing)
{
  if (Result<void> opened = stores_.open(drawing); !opened)
  {
    return opened;
  }
  Looks looks(drawing);
  looks.choose(stores_.clouds());
  return draw(looks);
}

Result<std::optional<std::string>> Appearance::obey(KeyAction action)
{
  Looks looks = looks_;
  std::optional<std::string> sentence = looks.obey(action);
  const Result<void> drawn = sentence ? draw(looks) : Result<void>();
  return drawn ? Result<std::optional<std::string>>(std::move(sentence)) : drawn.error();
}

Result<std::string> Appearance::listClasses()
{
  Result<ClassList> classes = ClassList::of(stores_.clouds(), drawing().classes);
  if (!classes)
  {
    return classes.error();
  }
  classes_ = std::move(*classes);
  return classes_.empty() ? std::string("no point has a class") : classes_.text();
}

Result<std::optional<std::string>> Appearance::obeyInList(KeyAction action)
{
  if (action == KeyAction::Up || action == KeyAction::Down)
  {
    classes_.move(action == KeyAction::Up ? -1 : 1);
    return std::optional<std::string>(classes_.text());
  }
  if (action != KeyAction::Toggle)
  {
    return std::optional<std::string>();
  }
  ClassList classes = classes_;
  classes.toggle();
  Looks looks = looks_;
  looks.showClasses(classes.shown());
  if (const Result<void> drawn = draw(looks); !drawn)
  {
    return drawn.error();
  }
  classes_ = std::move(classes);
  return std::optional<std::string>(classes_.text());
}

} // namespace pointfront
