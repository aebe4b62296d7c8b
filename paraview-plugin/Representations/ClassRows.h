#pragma once

#include "vtkNew.h"

#include <string>

class vtkPointFrontStyle;

namespace pointfront
{

struct StyleSheet;

/// Rows of a table: what differs for each class.
/// Threads  one.
class ClassRows
{
public:
  ClassRows();
  ~ClassRows();
  void clear();
  /// By code, or "" for all classes where `forAll` allows it: a technique, "blended" (splats, in
  /// two passes), "hidden" or ""; an attribute, "#rrggbb" or ""; pixels or "".
  void add(const std::string& code, const std::string& technique, const std::string& colour,
    const std::string& size, bool forAll = false);
  /// By code: "on", "off", how much comes from everywhere, or ""; a strength, 0 for off, or "".
  void addLight(
    const std::string& code, const std::string& light, const std::string& eyeDomeStrength);
  bool empty() const { return !filled_; }
  const std::string& wrong() const { return wrong_; } ///< the last row that is wrong; or empty
  /// The style of the rows: for all classes, and for each.
  const StyleSheet& sheet() const;

private:
  bool filled_ = false;
  std::string wrong_;
  vtkNew<vtkPointFrontStyle> style_;
};

} // namespace pointfront
