#pragma once

#include "pointfront/Front/LayerLimits.h"
#include "pointfront/Front/NodePruning.h"
#include "pointfront/Style/StyleSheet.h"
#include "vtkPointFrontStore.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

namespace pointfront
{

/// The limits that a mapper sets for object classes, by their number in a store (LAYERS-11).
class ClassLimits
{
public:
  LayerLimits of(int objectClass) const
  {
    const auto found = limits_.find(objectClass);
    return found != limits_.end() ? found->second : LayerLimits();
  }
  LayerLimits& operator[](int objectClass) { return limits_[objectClass]; }
  bool empty() const { return limits_.empty(); }
  void clear() { limits_.clear(); }

  /// Limits by number of the store's layer; empty if none was set.
  std::vector<LayerLimits> layersOf(vtkPointFrontStore& store) const
  {
    std::vector<LayerLimits> layers;
    const int classes = limits_.empty() ? 0 : store.GetNumberOfObjectClasses();
    layers.reserve(static_cast<std::size_t>(classes));
    for (int i = 0; i < classes; ++i)
    {
      layers.push_back(of(store.GetObjectClassNumber(i)));
    }
    return layers;
  }

  /// The same, with the error factors and shares of the layers' styles and the nodes that their
  /// filters leave out; empty if all layers have default limits.
  std::vector<LayerLimits> layersOf(vtkPointFrontStore& store,
    const std::vector<LayerStyling>& styling,
    const std::vector<std::shared_ptr<const NodePruning>>& pruning) const
  {
    std::vector<LayerLimits> layers = layersOf(store);
    layers.resize(styling.size());
    for (std::size_t layer = 0; layer < styling.size(); ++layer)
    {
      layers[layer].visible = styling[layer].visible();
      layers[layer].errorFactor *= styling[layer].errorFactor;
      // A share that the mapper was given counts more.
      layers[layer].share =
        layers[layer].share > 0.0 ? layers[layer].share : styling[layer].budgetShare;
      layers[layer].pruning = layer < pruning.size() ? pruning[layer] : nullptr;
    }
    const auto usual = [](const LayerLimits& limits) { return limits == LayerLimits(); };
    return std::all_of(layers.begin(), layers.end(), usual) ? std::vector<LayerLimits>() : layers;
  }
  /// Removes the styles of classes that are switched off.
  void hide(vtkPointFrontStore& store, std::vector<LayerStyling>& styling) const
  {
    const std::vector<LayerLimits> layers = layersOf(store);
    for (std::size_t layer = 0; layer < layers.size() && layer < styling.size(); ++layer)
    {
      if (!layers[layer].visible)
      {
        styling[layer].styles.clear();
      }
    }
  }

private:
  std::map<int, LayerLimits> limits_;
};

} // namespace pointfront
