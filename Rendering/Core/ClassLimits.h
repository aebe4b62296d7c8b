#pragma once

#include "pointfront/Front/LayerLimits.h"
#include "vtkPointFrontStore.h"

#include <map>
#include <vector>

namespace pointfront
{

/// What a mapper says of object classes, by their number in a store (LAYERS-11).
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

  /// By number of the store's layer; none where nothing was said.
  std::vector<LayerLimits> layersOf(vtkPointFrontStore& store) const
  {
    std::vector<LayerLimits> layers;
    const int classes = limits_.empty() ? 0 : store.GetNumberOfObjectClasses();
    for (int i = 0; i < classes; ++i)
    {
      layers.push_back(of(store.GetObjectClassNumber(i)));
    }
    return layers;
  }

private:
  std::map<int, LayerLimits> limits_;
};

} // namespace pointfront
