#pragma once

#include "ClassList.h"
#include "Looks.h"

#include "pointfront/Base/Result.h"

#include <optional>
#include <string>

class vtkRenderer;

namespace pointfront
{

class MappedStores;

/// How the window's stores are drawn, and the keys that change it. A change that the stores refuse
/// changes nothing.
class Appearance
{
public:
  Appearance(vtkRenderer* renderer, MappedStores& stores);

  /// Opens the stores of these options, and draws them so.
  /// Errors  those of MappedStores.
  Result<void> open(const DrawingOptions& drawing);
  const DrawingOptions& drawing() const { return looks_.drawing(); }
  /// Changes what the key is for, and gives a sentence about it; nothing: the key is for something
  /// else.
  Result<std::optional<std::string>> obey(KeyAction action);

  /// The classes of the stores, a line each.
  Result<std::string> listClasses();
  /// Up, Down and Toggle in that list. Gives the list; nothing: the key is for something else.
  Result<std::optional<std::string>> obeyInList(KeyAction action);

private:
  Result<void> draw(const Looks& looks);

  vtkRenderer* renderer_;
  MappedStores& stores_;
  Looks looks_{ DrawingOptions() };
  ClassList classes_;
};

} // namespace pointfront
