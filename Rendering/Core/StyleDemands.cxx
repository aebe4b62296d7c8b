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
  bool blended = false;
  for (const pointfront::LayerStyling& layer : this->GetStyling(actor))
  {
    for (const auto& style : layer.styles)
    {
      if (style->opacity < 1.0)
      {
        return false;
      }
      blended = blended || style->technique == pointfront::Technique::Ewa ||
        (style->technique == pointfront::Technique::Splats && style->blended);
    }
  }
  return blended;
}

void vtkPointFrontMapper::SetPictureExchange(pointfront::PictureExchange* exchange)
{
  this->Exchange = exchange;
}
