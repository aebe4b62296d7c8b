#include "pointfront/Style/LayerStyle.h"

namespace pointfront
{
namespace
{

template <typename T>
std::optional<T> either(const std::optional<T>& first, const std::optional<T>& second)
{
  return first ? first : second;
}

} // namespace

LayerStyle LayerStyle::over(const LayerStyle& below) const
{
  LayerStyle style;
  style.technique = either(technique, below.technique);
  style.colour = either(colour, below.colour);
  style.size = either(size, below.size);
  style.orientation = either(orientation, below.orientation);
  style.opacity = either(opacity, below.opacity);
  style.visible = either(visible, below.visible);
  style.errorFactor = either(errorFactor, below.errorFactor);
  style.budgetShare = either(budgetShare, below.budgetShare);
  style.blended = either(blended, below.blended);
  style.accuracy = either(accuracy, below.accuracy);
  style.rim = either(rim, below.rim);
  style.wall = either(wall, below.wall);
  style.where = either(where, below.where);
  style.epoch = either(epoch, below.epoch);
  style.light = either(light, below.light);
  style.eyeDome = either(eyeDome, below.eyeDome);
  return style;
}

LayerStyle standardStyle()
{
  LayerStyle style;
  style.technique = Technique::Points;
  style.colour = ColourSource();
  style.size = StyleSize();
  style.orientation = StyleOrientation();
  style.opacity = 1.0;
  style.visible = true;
  style.errorFactor = 1.0;
  style.budgetShare = 0.0;
  style.blended = false;
  style.accuracy = SplatAccuracy::Affine;
  style.rim = Rgba8{ 0, 0, 0, 255 };
  style.where = FilterExpression();
  return style;
}

} // namespace pointfront
