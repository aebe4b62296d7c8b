#pragma once

#include "pointfront/Front/NodePruning.h"
#include "pointfront/Style/AttributeRanges.h"
#include "pointfront/Style/ResolvedStyle.h"
#include "pointfront/Style/StyleSheet.h"

#include <vtkType.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// Points of some pixels, in one colour each, all of them, and nothing done to the picture.
bool hasPlainPointsOnly(const FrameShading& shading, const std::vector<LayerStyling>& layers);

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

  /// How a store's layers are drawn: by the sheet, or where that is null or asks for what the store
  /// has not, by the properties.
  std::vector<LayerStyling> layersOf(vtkPolyDataMapper& mapper, vtkActor* actor, double pointSizePx,
    const StyleSheet* sheet, const std::shared_ptr<const StoredCloud>& store);
  /// By a sheet in the place of the properties. Nothing, and an error to take, where the store does
  /// not have what it asks for.
  std::optional<std::vector<LayerStyling>> resolve(
    const StyleSheet& sheet, const std::shared_ptr<const StoredCloud>& store);
  /// For each layer the nodes that its filters leave out (FilterPruning.h), of what was resolved.
  const std::vector<std::shared_ptr<const NodePruning>>& pruning() const { return pruning_; }
  /// Why a sheet could not be resolved, once for a sheet and a store; empty: nothing.
  std::string takeError() { return std::exchange(error_, {}); }

  PointColouring colouringOf(
    vtkPolyDataMapper& mapper, const std::shared_ptr<const StoredCloud>& store);
  /// What the user should know, once each; empty: nothing.
  std::string takeWarning() { return std::exchange(warning_, {}); }

private:
  std::shared_ptr<const ColourMap> mapOf(
    vtkPolyDataMapper& mapper, const PointColouring& colouring);

  void wantHeights(const std::shared_ptr<const StoredCloud>& store);

  std::shared_ptr<const ResolvedStyle> style_;
  std::optional<StyleSheet> sheet_; ///< that layers_ are of
  std::shared_ptr<const StoredCloud> sheetStore_;
  std::shared_ptr<const AttributeRanges> ranges_; ///< of sheetStore_
  std::optional<std::vector<LayerStyling>> layers_;
  std::vector<std::shared_ptr<const NodePruning>> pruning_; ///< of layers_
  std::string error_;
  std::shared_ptr<const ColourMap> map_;
  PointColouring mapColouring_; ///< that map_ is for
  vtkScalarsToColors* mapTable_ = nullptr; ///< that it was sampled from; compared, not used
  vtkMTimeType mapTime_ = 0;
  std::shared_ptr<const ClassHeights> heights_; ///< once they were asked for
  std::string unknownArray_; ///< that has been warned of
  bool indexedWarned_ = false;
  std::string warning_;
};

} // namespace pointfront
