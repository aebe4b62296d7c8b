#pragma once

#include "pointfront/Plan/SlotOrigin.h"

#include <vtkNew.h>

#include <cstdint>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace pointfront
{

/// What the vertex shader knows of each slot of a GpuPool, as texture buffers that gl_VertexID /
/// slotPoints indexes: one record a slot instead of one draw call a node.
/// Threads  that of the GL context, current in all functions but the constructor.
class SlotRecords
{
public:
  SlotRecords();
  ~SlotRecords();

  /// A frame begins; `slots` is the pool's number of slots.
  void begin(std::uint32_t slots);
  /// `coloured`: the slots' values are there. `firstId`: 48-bit id of the node's first point.
  void set(const std::vector<std::uint32_t>& slots, const SlotOrigin& origin, bool coloured,
    std::uint64_t firstId);
  /// To the GPU.
  void upload(vtkOpenGLRenderWindow* window);

  /// Binds the textures to units and gives their numbers to `program`.
  void activate(vtkShaderProgram* program);
  void deactivate();
  void release(vtkWindow* window);

private:
  struct Column;
  void load(vtkOpenGLRenderWindow* window, vtkTextureObject* texture, vtkOpenGLBufferObject* buffer,
    const void* data, bool integers);

  std::vector<std::int32_t> steps_; ///< 4 a slot
  std::vector<float> bases_;        ///< 4 a slot
  std::vector<std::int32_t> ids_;   ///< 4 a slot
  vtkNew<vtkOpenGLBufferObject> stepsBuffer_;
  vtkNew<vtkOpenGLBufferObject> basesBuffer_;
  vtkNew<vtkOpenGLBufferObject> idsBuffer_;
  vtkNew<vtkTextureObject> stepsTexture_;
  vtkNew<vtkTextureObject> basesTexture_;
  vtkNew<vtkTextureObject> idsTexture_;
};

} // namespace pointfront
