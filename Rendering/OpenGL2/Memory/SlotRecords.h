#pragma once

#include "pointfront/Plan/PointGrowth.h"
#include "pointfront/Plan/SlotOrigin.h"

#include <vtkNew.h>

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace pointfront
{

/// The facts about each slot of a GpuPool that the vertex shader reads, as texture buffers indexed
/// by gl_VertexID / slotPoints: one record a slot instead of one draw call a node.
/// Threads  that of the GL context, current in all functions but the constructor.
class SlotRecords
{
public:
  /// The record of one node.
  struct Record
  {
    SlotOrigin origin;
    bool coloured = false; ///< the slots' values are there
    bool shaped = false; ///< normals and codes of radii are there
    bool sized = false; ///< radii of their own are there
    std::uint64_t firstId = 0; ///< 48-bit id of the node's first point
    glm::vec4 place{ 0.0f }; ///< camera space of the reference's steps; w: set() does that
    PointGrowth growth;
    /// World units: what closes the node, scale of a point's own, 1 where none is below what closes
    /// it, what closes its sparsest part.
    glm::vec4 radii{ 0.0f };
  };

  SlotRecords();
  ~SlotRecords();

  /// Begins a frame; `slots` is the pool's number of slots.
  void begin(std::uint32_t slots);
  void set(const std::vector<std::uint32_t>& slots, const Record& record);
  /// Gives the node in these slots a number (StoredPoint.glsl: of stand-ins).
  void setNumber(const std::vector<std::uint32_t>& slots, std::int32_t number);
  /// Uploads the records.
  void upload(vtkOpenGLRenderWindow* window);

  /// Binds the textures that `program` uses to units and gives it their numbers.
  void activate(vtkShaderProgram* program);
  void deactivate();
  void release(vtkWindow* window);

private:
  static constexpr std::size_t count = 5;
  struct Column
  {
    std::vector<std::int32_t> values; ///< 4 a slot; floats as their bits
    vtkNew<vtkOpenGLBufferObject> buffer;
    vtkNew<vtkTextureObject> texture;
  };
  void load(vtkOpenGLRenderWindow* window, Column& column, bool integers);

  std::array<Column, count> columns_;
};

} // namespace pointfront
