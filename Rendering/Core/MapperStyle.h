#pragma once

#include "pointfront/Style/ResolvedStyle.h"

#include <vtkType.h>

#include <memory>
#include <string>
#include <utility>

class vtkActor;
class vtkPolyDataMapper;
class vtkScalarsToColors;

namespace pointfront
{

/// A VTK lookup table or transfer function as a map of its own.
/// Values   attributes of few different whole numbers get one entry each, so that indexed tables,
///          class colours and annotations are exact; else a table of n colours gets n entries, a
///          continuous function 8192. Below- and above-range and NaN colours are VTK's own. A
///          logarithmic table of negative values is sampled in equal steps.
ColourMap sampleColours(vtkScalarsToColors& table, const PointColouring& colouring);

/// The style that the properties of a mapper and of its actor come to: points of some pixels,
/// coloured as any vtkMapper's are.
/// Threads  the renderer's.
class MapperStyle
{
public:
  /// What they say now. The same object as long as that does not change.
  /// `pointSizePx`: 0 is the property's.
  std::shared_ptr<const ResolvedStyle> update(vtkPolyDataMapper& mapper, vtkActor* actor,
    double pointSizePx, const std::shared_ptr<const StoredCloud>& store);

  PointColouring colouringOf(
    vtkPolyDataMapper& mapper, const std::shared_ptr<const StoredCloud>& store);
  /// What the user should know, once each; empty: nothing.
  std::string takeWarning() { return std::exchange(warning_, {}); }

private:
  std::shared_ptr<const ColourMap> mapOf(
    vtkPolyDataMapper& mapper, const PointColouring& colouring);

  std::shared_ptr<const ResolvedStyle> style_;
  std::shared_ptr<const ColourMap> map_;
  PointColouring mapColouring_; ///< that map_ is for
  vtkScalarsToColors* mapTable_ = nullptr; ///< that it was sampled from; compared, not used
  vtkMTimeType mapTime_ = 0;
  std::shared_ptr<const ClassHeights> heights_; ///< once they were asked for
  std::string unknownArray_;                    ///< that has been warned of
  bool indexedWarned_ = false;
  std::string warning_;
};

} // namespace pointfront
