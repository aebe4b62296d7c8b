#pragma once

#include "vtkSmartPointer.h"

#include <string>

class vtkPointFrontMapper;
class vtkScalarsToColors;

namespace pointfront
{

struct LookColour;

/// Which colours a representation's points have: an array's, by a table or as they are, greys by
/// height, or one colour for all.
/// Threads  one.
class CloudColors
{
public:
  CloudColors();
  ~CloudColors();

  /// Which arrays go through the table: all where `mapScalars` is set, but "rgb" not where
  /// `directColors` is set, too.
  struct Mapping
  {
    bool mapScalars = true;
    bool directColors = true;
  };

  /// False for what names points: "point_id".
  static bool isColour(const std::string& array) { return array != "point_id"; }

  vtkSmartPointer<vtkScalarsToColors> table; ///< the map from values to colours

  /// Tells the mapper, which knows its store and its piece, which colours `array` asks for; empty:
  /// one colour. Returns what the user should be told of it; empty where there is nothing new.
  std::string choose(vtkPointFrontMapper& mapper, const std::string& array, const Mapping& mapping);

  /// The colours of a style: what was chosen last. `flat` is left as it is.
  void describe(vtkPointFrontMapper& mapper, LookColour& colour) const;

  /// The warning that opacities of the table are not drawn; empty where there
  /// is nothing new. `styled`: the mapper draws a style.
  std::string lostOpacities(vtkPointFrontMapper& mapper, bool styled);

private:
  vtkScalarsToColors* drawnTable(vtkPointFrontMapper& mapper);
  vtkScalarsToColors* heightTable(vtkPointFrontMapper& mapper);
  bool tableHasOpacities() const;

  std::string array_; ///< empty: one colour
  bool direct_ = false; ///< its components are the colour
  bool toldOfNames_ = false; ///< that they are no colours
  bool toldOfOpacities_ = false;
  vtkSmartPointer<vtkScalarsToColors> opaque_; ///< the table without its opacities
  vtkSmartPointer<vtkScalarsToColors> heights_;
};

} // namespace pointfront
