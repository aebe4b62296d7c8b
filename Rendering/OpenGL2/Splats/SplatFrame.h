#pragma once

#include "SlotRecords.h"
#include "SplatHoleFiller.h"
#include "SplatProgram.h"
#include "SplatTarget.h"

#include <vtkNew.h>
#include <vtkOpenGLVertexArrayObject.h>

#include <functional>
#include <memory>

class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace pointfront
{
struct ColourMap;
class ColourMapTexture;
class GpuPool;

/// The tools with which all parts of a picture are drawn.
struct SplatTools
{
  SplatPrograms programs;
  SlotRecords records;
  SlotRecords lastRecords; ///< records of points that the last picture has and this one lacks
  SplatHoleFiller holes;
  // Refining views have these:
  SplatTarget together[2]; ///< who is seen, with layers (SplatLayer)
  SplatTarget growing; ///< points that have not grown to their size
  vtkNew<vtkOpenGLVertexArrayObject> vertices;

  void releaseTogether(vtkOpenGLRenderWindow* window)
  {
    together[0].release(window);
    together[1].release(window);
    growing.release(window);
  }
};

/// One drawing of a picture.
struct SplatFrame
{
  using TableOf = std::function<ColourMapTexture*(const std::shared_ptr<const ColourMap>&)>;

  vtkOpenGLRenderWindow* window = nullptr;
  vtkRenderer* renderer = nullptr;
  const GpuPool* pool = nullptr;
  TableOf tableOf;
  bool ids = false; ///< for a selection
  bool unfinished = false; ///< more points come to the GPU, and another frame with them
};

} // namespace pointfront
