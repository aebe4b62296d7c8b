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

/// Whether the styles are plain: every point is drawn with a size of some pixels in one colour, and
/// nothing is done to the finished picture.
bool hasPlainPointsOnly(const FrameShading& shading, const std::vector<LayerStyling>& layers);

/// Turns the properties of a mapper and of its actor into a style: points of some pixels, coloured
/// as with any vtkMapper.
/// Threads  the renderer's.
class MapperStyle
{
public:
  /// The style of the current properties; the same object as long as they do not change.
  /// `pointSizePx`: 0 means the size of the actor's property.
  std::shared_ptr<const ResolvedStyle> update(vtkPolyDataMapper& mapper, vtkActor* actor,
    double pointSizePx, const std::shared_ptr<const StoredCloud>& store);

  /// How a store's layers are drawn: by the sheet; by the properties if the sheet is null or asks
  /// for an attribute that the store lacks.
  std::vector<LayerStyling> layersOf(vtkPolyDataMapper& mapper, vtkActor* actor, double pointSizePx,
    const StyleSheet* sheet, const std::shared_ptr<const StoredCloud>& store);
  /// Resolves a sheet, which replaces the properties. Returns nothing, and sets an error to take,
  /// if the store lacks an attribute that the sheet asks for.
  std::optional<std::vector<LayerStyling>> resolve(
    const StyleSheet& sheet, const std::shared_ptr<const StoredCloud>& store);
  /// For each layer of the last resolved sheet, the nodes that its filters leave out
  /// (FilterPruning.h).
  const std::vector<std::shared_ptr<const NodePruning>>& pruning() const { return pruning_; }
  /// Why a sheet could not be resolved, once for a sheet and a store; empty: nothing.
  std::string takeError() { return std::exchange(error_, {}); }

  PointColouring colouringOf(
    vtkPolyDataMapper& mapper, const std::shared_ptr<const StoredCloud>& store);
  /// A warning for the user, once each; empty: nothing.
  std::string takeWarning() { return std::exchange(warning_, {}); }

private:
  std::shared_ptr<const ColourMap> mapOf(
    vtkPolyDataMapper& mapper, const PointColouring& colouring);

  void wantHeights(const std::shared_ptr<const StoredCloud>& store);
  void tellOfTable(
    vtkPolyDataMapper& mapper, const std::string& name, const Attribute* attribute, int component);

  std::shared_ptr<const ResolvedStyle> style_;
  std::optional<StyleSheet> sheet_; ///< that layers_ are of
  std::shared_ptr<const StoredCloud> sheetStore_;
  std::shared_ptr<const AttributeRanges> ranges_; ///< ranges in sheetStore_
  std::optional<std::vector<LayerStyling>> layers_;
  std::vector<std::shared_ptr<const NodePruning>> pruning_; ///< pruning of layers_
  std::string error_;
  std::shared_ptr<const ColourMap> map_;
  PointColouring mapColouring_; ///< that map_ is for
  vtkScalarsToColors* mapTable_ = nullptr; ///< that it was sampled from; compared, not used
  vtkMTimeType mapTime_ = 0;
  std::shared_ptr<const ClassHeights> heights_; ///< once they were asked for
  std::string unknownArray_; ///< that has been warned of
  bool indexedWarned_ = false;
  bool rangeWarned_ = false;
  bool directWarned_ = false;
  bool vectorsWarned_ = false;
  std::string warning_;
};

} // namespace pointfront
