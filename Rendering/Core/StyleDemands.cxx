/// The part of vtkPointFrontMapper that says what its style demands of who draws.

#include "vtkPointFrontMapper.h"

#include "MapperStyle.h"

#include "pointfront/Plan/FramePlan.h"

#include <algorithm>
#include <cstdint>
#include <set>

bool vtkPointFrontMapper::NeedsPictureExchange(vtkActor* actor, bool inMotion)
{
  const auto sheet = this->GetStore() ? this->GetStyleSheet() : nullptr;
  if (!sheet)
  {
    return false;
  }
  const pointfront::FrameShading& shading = sheet->frameShading();
  const auto isAroundClass = [](const pointfront::FrameLens& lens)
  { return lens.shape == pointfront::LensShape::AroundClass; };
  // Pixels around one, and what covers it, may be of other processes.
  if ((shading.reachPx() > 0 && !inMotion) || !shading.highlights.empty() ||
    std::any_of(shading.lenses.begin(), shading.lenses.end(), isAroundClass))
  {
    return true;
  }
  std::set<std::uint16_t> surfaces;
  for (const pointfront::LayerStyling& layer : this->GetStyling(actor))
  {
    for (const auto& style : layer.styles)
    {
      const bool blends = style->technique == pointfront::Technique::Ewa ||
        (style->technique == pointfront::Technique::Splats && style->blended);
      if (blends && !inMotion)
      {
        return true;
      }
      surfaces.insert(style->group);
    }
  }
  return surfaces.size() > 1; // one that is translucent lies over another
}

void vtkPointFrontMapper::SetPictureExchange(pointfront::PictureExchange* exchange)
{
  this->Exchange = exchange;
}
