#pragma once

#include "DrawingOptions.h"
#include "KeyTable.h"

#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// How the window draws, one key press after the other. Each change gives a sentence for the user.
class Looks
{
public:
  explicit Looks(const DrawingOptions& drawing)
    : drawing_(drawing)
  {
  }
  /// The stores that are drawn: they decide which colours there are.
  void choose(const std::vector<std::shared_ptr<const StoredCloud>>& stores);

  const DrawingOptions& drawing() const { return drawing_; }
  /// Changes what the key is for; nothing: the key is for something else.
  std::optional<std::string> obey(KeyAction action);
  /// Sorted codes; empty: all classes.
  void showClasses(std::vector<std::uint8_t> codes);

  /// Attributes that tell points of the stores apart, in the order of colours: the best known
  /// first, none that has the same value everywhere.
  const std::vector<std::string>& colours() const { return colours_; }

private:
  /// `step`  1: the next; -1: the one before.
  std::string changeColour(int step);
  std::string changeTechnique(int step);
  /// The next of the presets of --quality, which set technique and error.
  std::string changeQuality();
  std::string toggleEyeDome();
  /// `factor`  of the size of a point.
  std::string resize(double factor);

  DrawingOptions drawing_;
  std::vector<std::string> colours_;
};

} // namespace pointfront
