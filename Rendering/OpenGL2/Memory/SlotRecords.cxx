#include "SlotRecords.h"

#include "GpuPool.h"
#include "OpenGLFunctions.h"

#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{

// Beside the shift in the low byte; see PointsVS.glsl, SplatVS.glsl.
constexpr std::int32_t colouredFlag = 256;
constexpr std::int32_t shapedFlag = 512;
constexpr std::int32_t sizedFlag = 1024;

struct Name
{
  const char* uniform;
  bool integers;
};
constexpr Name names[] = { { "slotSteps", true }, { "slotBase", false }, { "slotIds", true },
  { "slotPlaces", false }, { "slotRadii", false } };

void put(std::vector<std::int32_t>& values, std::size_t at, const glm::vec4& numbers)
{
  std::memcpy(values.data() + at, &numbers.x, sizeof(numbers));
}

} // namespace

SlotRecords::SlotRecords() = default;
SlotRecords::~SlotRecords() = default;

void SlotRecords::begin(std::uint32_t slots)
{
  for (Column& column : columns_)
  {
    column.values.assign(std::size_t(4) * std::max(1u, slots), 0);
  }
}

void SlotRecords::set(const std::vector<std::uint32_t>& slots, const Record& record)
{
  std::uint64_t id = record.firstId;
  float first = record.growth.first; // growth of the slot's first point
  const SlotOrigin& origin = record.origin;
  const std::int32_t flags = (record.coloured ? colouredFlag : 0) |
    (record.shaped ? shapedFlag : 0) | (record.sized ? sizedFlag : 0);
  for (const std::uint32_t slot : slots)
  {
    const std::size_t at = std::size_t(4) * slot;
    std::int32_t* const steps = columns_[0].values.data() + at;
    std::copy(&origin.steps.x, &origin.steps.x + 3, steps);
    steps[3] = origin.shift | flags;
    put(columns_[1].values, at, glm::vec4(origin.base, record.growth.perPoint));
    columns_[2].values[at] = static_cast<std::int32_t>(id & 0xffffffu);
    columns_[2].values[at + 1] = static_cast<std::int32_t>((id >> 24) & 0xffffffu);
    put(columns_[3].values, at, glm::vec4(glm::vec3(record.place), first));
    first -= record.growth.perPoint * static_cast<float>(GpuPool::slotPoints);
    put(columns_[4].values, at, record.radii);
    id += GpuPool::slotPoints;
  }
}

void SlotRecords::setNumber(const std::vector<std::uint32_t>& slots, std::int32_t number)
{
  for (const std::uint32_t slot : slots)
  {
    columns_[2].values[std::size_t(4) * slot + 2] = number;
  }
}

void SlotRecords::load(vtkOpenGLRenderWindow* window, Column& column, bool integers)
{
  const std::size_t values = column.values.size();
  column.buffer->Upload(column.values.data(), values, vtkOpenGLBufferObject::TextureBuffer);
  if (column.texture->GetHandle() == 0)
  {
    column.texture->SetContext(window);
    column.texture->SetInternalFormat(integers ? GL_RGBA32I : GL_RGBA32F);
    column.texture->SetFormat(integers ? GL_RGBA_INTEGER : GL_RGBA);
    column.texture->CreateTextureBuffer(
      static_cast<unsigned int>(values / 4), 4, integers ? VTK_INT : VTK_FLOAT, column.buffer);
  }
}

void SlotRecords::upload(vtkOpenGLRenderWindow* window)
{
  for (std::size_t number = 0; number < count; ++number)
  {
    this->load(window, columns_[number], names[number].integers);
  }
}

void SlotRecords::activate(vtkShaderProgram* program)
{
  for (std::size_t number = 0; number < count; ++number)
  {
    if (program->IsUniformUsed(names[number].uniform))
    {
      columns_[number].texture->Activate();
      program->SetUniformi(names[number].uniform, columns_[number].texture->GetTextureUnit());
    }
  }
  program->SetUniformi("slotPoints", static_cast<int>(GpuPool::slotPoints));
}

void SlotRecords::deactivate()
{
  for (Column& column : columns_)
  {
    if (column.texture->GetTextureUnit() >= 0)
    {
      column.texture->Deactivate();
    }
  }
}

void SlotRecords::release(vtkWindow* window)
{
  for (Column& column : columns_)
  {
    column.texture->ReleaseGraphicsResources(window);
    column.buffer->ReleaseGraphicsResources();
  }
}

} // namespace pointfront
