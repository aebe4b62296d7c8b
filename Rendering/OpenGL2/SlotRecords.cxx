#include "SlotRecords.h"

#include "GpuPool.h"

#include <vtk_glew.h>

#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::int32_t colouredFlag = 256; // beside the shift in the low byte; see PointsVS.glsl
}

SlotRecords::SlotRecords() = default;
SlotRecords::~SlotRecords() = default;

void SlotRecords::begin(std::uint32_t slots)
{
  const std::size_t values = std::size_t(4) * std::max(1u, slots);
  steps_.assign(values, 0);
  bases_.assign(values, 0.0f);
  ids_.assign(values, 0);
}

void SlotRecords::set(const std::vector<std::uint32_t>& slots, const SlotOrigin& origin,
  bool coloured, std::uint64_t firstId)
{
  std::uint64_t id = firstId;
  for (const std::uint32_t slot : slots)
  {
    const std::size_t at = std::size_t(4) * slot;
    for (int axis = 0; axis < 3; ++axis)
    {
      steps_[at + axis] = origin.steps[axis];
      bases_[at + axis] = origin.base[axis];
    }
    steps_[at + 3] = origin.shift | (coloured ? colouredFlag : 0);
    ids_[at] = static_cast<std::int32_t>(id & 0xffffffu);
    ids_[at + 1] = static_cast<std::int32_t>((id >> 24) & 0xffffffu);
    id += GpuPool::slotPoints;
  }
}

void SlotRecords::load(vtkOpenGLRenderWindow* window, vtkTextureObject* texture,
  vtkOpenGLBufferObject* buffer, const void* data, bool integers)
{
  const std::size_t values = steps_.size();
  if (integers)
  {
    buffer->Upload(static_cast<const int*>(data), values, vtkOpenGLBufferObject::TextureBuffer);
  }
  else
  {
    buffer->Upload(static_cast<const float*>(data), values, vtkOpenGLBufferObject::TextureBuffer);
  }
  if (texture->GetHandle() == 0)
  {
    texture->SetContext(window);
    texture->SetInternalFormat(integers ? GL_RGBA32I : GL_RGBA32F);
    texture->SetFormat(integers ? GL_RGBA_INTEGER : GL_RGBA);
    texture->CreateTextureBuffer(
      static_cast<unsigned int>(values / 4), 4, integers ? VTK_INT : VTK_FLOAT, buffer);
  }
}

void SlotRecords::upload(vtkOpenGLRenderWindow* window)
{
  this->load(window, stepsTexture_, stepsBuffer_, steps_.data(), true);
  this->load(window, basesTexture_, basesBuffer_, bases_.data(), false);
  this->load(window, idsTexture_, idsBuffer_, ids_.data(), true);
}

void SlotRecords::activate(vtkShaderProgram* program)
{
  stepsTexture_->Activate();
  basesTexture_->Activate();
  program->SetUniformi("slotSteps", stepsTexture_->GetTextureUnit());
  program->SetUniformi("slotBase", basesTexture_->GetTextureUnit());
  program->SetUniformi("slotPoints", static_cast<int>(GpuPool::slotPoints));
  if (program->IsUniformUsed("slotIds"))
  {
    idsTexture_->Activate();
    program->SetUniformi("slotIds", idsTexture_->GetTextureUnit());
  }
}

void SlotRecords::deactivate()
{
  stepsTexture_->Deactivate();
  basesTexture_->Deactivate();
  if (idsTexture_->GetTextureUnit() >= 0)
  {
    idsTexture_->Deactivate();
  }
}

void SlotRecords::release(vtkWindow* window)
{
  for (vtkTextureObject* texture :
    {stepsTexture_.GetPointer(), basesTexture_.GetPointer(), idsTexture_.GetPointer()})
  {
    texture->ReleaseGraphicsResources(window);
  }
  for (vtkOpenGLBufferObject* buffer :
    {stepsBuffer_.GetPointer(), basesBuffer_.GetPointer(), idsBuffer_.GetPointer()})
  {
    buffer->ReleaseGraphicsResources();
  }
}

} // namespace pointfront
