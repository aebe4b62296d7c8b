#pragma once

#include "ClassLimits.h"
#include "MapperFronts.h"
#include "MapperStyle.h"
#include "RenderTimer.h"

#include "pointfront/Plan/FrameStatistics.h"
#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStyle.h"

#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <utility>

/// The members of a mapper.
struct vtkPointFrontMapper::Content
{
  explicit Content(vtkPointFrontMapper* owner)
    : Views([owner] { owner->LeaveScreen(); })
    , Timer([owner] { return owner->Announce(); })
  {
  }

  std::string StoreName;
  vtkMTimeType InputTime = 0;
  bool MissingTold = false; ///< that this input names no store
  bool OtherPointsTold = false; ///< that this input's points are not the store's
  std::pair<vtkTypeInt64, vtkIdType> LeftOutTold{ -1, -1 }; ///< with these budgets
  bool LeftOutIgnored = false;
  pointfront::MapperFronts Views;
  pointfront::ClassLimits Limits;
  pointfront::MapperStyle Style;
  std::shared_ptr<const pointfront::StyleSheet> Sheet;
  vtkSmartPointer<vtkPointFrontStyle> VTKStyle; ///< goes before Sheet
  pointfront::FrameStatistics Statistics;
  pointfront::RenderTimer Timer;
};
