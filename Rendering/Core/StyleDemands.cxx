/// Of vtkPointFrontMapper: what its style demands of who draws.

#include "vtkPointFrontMapper.h"

#include "MapperStyle.h"

#include "pointfront/Plan/FramePlan.h"

#include <vector>

bool vtkPointFrontMapper::AddsUpSplats(vtkActor* actor)
{
  const auto sheet = this->GetStore() ? this->GetStyleSheet() : nullptr;
  if (!sheet || !sheet->frameShading().lenses.empty() || !sheet->frameShading().highlights.empty())
  {
    return false;
  }
  // Eye-dome lighting and filled holes look at pixels that other processes draw.
  bool wanted = sheet->frameShading().reachPx() > 0;
  for (const pointfront::LayerStyling& layer : this->GetStyling(actor))
  {
    for (const auto& style : layer.styles)
    {
      if (style->opacity < 1.0)
      {
        return false;
      }
      wanted = wanted || style->technique == pointfront::Technique::Ewa ||
        (style->technique == pointfront::Technique::Splats && style->blended);
    }
  }
  return wanted;
}

void vtkPointFrontMapper::SetPictureExchange(pointfront::PictureExchange* exchange)
{
  this->Exchange = exchange;
}
