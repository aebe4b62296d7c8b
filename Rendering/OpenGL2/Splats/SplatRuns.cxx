#include "SplatRuns.h"

#include "ColourMapTexture.h"
#include "DrawBatches.h"
#include "GpuPool.h"
#include "RasterItems.h"
#include "SplatAttributes.h"
#include "SplatUniforms.h"

#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>

namespace pointfront
{

SplatVariant variantOf(
  const SplatGroups::Group& group, const SplatTarget::Parts& parts, bool second)
{
  const RasterItem& item = *group.first;
  const ResolvedStyle& style = *item.style;
  SplatVariant variant;
  variant.square = item.passes.squares;
  variant.shape = second ? item.passes.second.shape : item.passes.first.shape;
  variant.parallel = item.camera.parallel;
  variant.second = second;
  variant.marked = group.mark >= 0;
  variant.colour = variant.marked ? PointColouring::Kind::Direct : style.colouring.kind;
  variant.shaped = group.shaped;
  variant.normals = !item.passes.walls() && group.shaped && style.normalColumn &&
    style.orientation == SplatOrientation::Normal;
  variant.radius = radiusSourceOf(item, group.shaped, group.sized);
  variant.lit = parts.lit && !second;
  variant.ids = parts.ids && !second;
  variant.quads = group.quads;
  return variant;
}

void setTexture(vtkShaderProgram* program, const char* name, vtkTextureObject* texture)
{
  if (program->IsUniformUsed(name))
  {
    texture->Activate();
    program->SetUniformi(name, texture->GetTextureUnit());
  }
}

void drawSplatRuns(const SplatFrame& frame, SlotRecords& records, vtkShaderProgram* program,
  const SplatVariant& variant, const SplatGroups::Group& group, const DrawRuns& runs)
{
  const ResolvedStyle& style = *group.first->style;
  records.activate(program);
  setSplatUniforms(program, *group.items, *group.first, variant.second);
  program->SetUniformi("styleMark", group.mark);
  float flat[4];
  std::transform(style.flat.begin(), style.flat.end(), flat,
    [](std::uint8_t value) { return static_cast<float>(value) / 255.0f; });
  program->SetUniform4f("flatColour", flat);
  const FramePlan& plan = group.items->plan();
  const float stepSize[3] = { static_cast<float>(plan.grid.scale.x),
    static_cast<float>(plan.grid.scale.y), static_cast<float>(plan.grid.scale.z) };
  program->SetUniform3f("stepSize", stepSize);
  const bool tabled = !variant.marked && style.colouring.usesTable() && style.map;
  ColourMapTexture* const table = tabled ? frame.tableOf(style.map) : nullptr;
  if (table)
  {
    table->activate(program, style.colouring, plan.camera.reference.z, plan.grid.scale.z);
  }
  {
    const SplatAttributes attributes(program, variant.colour, valueStreamOf(valueSetOf(style)));
    DrawBatches batches;
    for (const DrawRuns::Stretch& stretch : runs.stretches())
    {
      const GpuBlock& block = frame.pool->memory().blocks()[stretch.block];
      attributes.read(block);
      program->SetUniformi("firstSlot", static_cast<int>(block.first()));
      batches.draw(
        runs.firsts() + stretch.begin, runs.counts() + stretch.begin, stretch.end - stretch.begin);
    }
  }
  if (table)
  {
    table->deactivate();
  }
  records.deactivate();
}

} // namespace pointfront
