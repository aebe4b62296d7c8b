#pragma once

#include "pointfront/Style/LayerStyle.h"

#include <array>
#include <string_view>

namespace pointfront
{

/// A place between speed and accuracy: how points become pixels, and how fine (docs/tradeoffs.md
/// has each one's time and truth).
struct QualityPreset
{
  const char* name;
  Technique technique;
  bool blended;
  SplatAccuracy accuracy;
  double errorPx; ///< the projected spacing that is refined to

  void applyTo(LayerStyle& style) const
  {
    style.technique = technique;
    style.blended = blended;
    style.accuracy = accuracy;
  }
};

/// From the fastest to the most accurate: places on the curve of docs/tradeoffs.md. The affine
/// accuracy is nearer to the truth there than the full one at the same error; docs/adr/0016.
constexpr std::array<QualityPreset, 3> qualityPresets{ {
  { "draft", Technique::Splats, false, SplatAccuracy::Affine, 2.0 },
  { "balanced", Technique::Splats, true, SplatAccuracy::Affine, 1.0 },
  { "exact", Technique::Ewa, true, SplatAccuracy::Affine, 0.5 },
} };

/// Null for another name.
inline const QualityPreset* qualityPresetOf(std::string_view name)
{
  for (const QualityPreset& preset : qualityPresets)
  {
    if (preset.name == name)
    {
      return &preset;
    }
  }
  return nullptr;
}

} // namespace pointfront
