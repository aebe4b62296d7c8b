#pragma once

#include "GpuBlock.h"
#include "OpenGLFunctions.h"

#include "pointfront/Style/PointColouring.h"

#include <vtkShaderProgram.h>

#include <cstdint>

namespace pointfront
{

/// Vertex attributes that read from one block after the other.
class SplatAttributes
{
public:
  SplatAttributes(vtkShaderProgram* program, PointColouring::Kind colour, GpuStream values)
    : positions_(locationOf(program, "positionSteps"))
    , values_(
        locationOf(program, colour == PointColouring::Kind::Direct ? "pointColour" : "pointValue"))
    , shapes_(locationOf(program, "pointShape"))
    , sizes_(locationOf(program, "pointSize"))
    , heights_(locationOf(program, "pointHeight"))
    , colours_(colour == PointColouring::Kind::Direct)
    , valueStream_(values)
  {
  }
  ~SplatAttributes()
  {
    for (const GLint location : { positions_, values_, shapes_, sizes_, heights_ })
    {
      if (location >= 0)
      {
        glDisableVertexAttribArray(static_cast<GLuint>(location));
      }
    }
    glBindBuffer(GL_ARRAY_BUFFER, 0);
  }
  SplatAttributes(const SplatAttributes&) = delete;
  SplatAttributes& operator=(const SplatAttributes&) = delete;

  void read(const GpuBlock& block) const
  {
    integers(positions_, 3, block.positionBuffer());
    numbers(values_, colours_ ? 4 : 1, colours_ ? GL_UNSIGNED_BYTE : GL_FLOAT,
      block.buffer(valueStream_));
    integers(shapes_, 1, block.buffer(GpuStream::Shape));
    numbers(sizes_, 1, GL_FLOAT, block.buffer(GpuStream::Size));
    numbers(heights_, 1, GL_FLOAT, block.buffer(GpuStream::Height));
  }

private:
  static GLint locationOf(vtkShaderProgram* program, const char* name)
  {
    const GLint location = glGetAttribLocation(static_cast<GLuint>(program->GetHandle()), name);
    if (location >= 0)
    {
      glEnableVertexAttribArray(static_cast<GLuint>(location));
    }
    return location;
  }
  static void integers(GLint location, GLint size, std::uint32_t buffer)
  {
    if (location >= 0)
    {
      glBindBuffer(GL_ARRAY_BUFFER, buffer);
      glVertexAttribIPointer(static_cast<GLuint>(location), size, GL_UNSIGNED_INT, 0, nullptr);
    }
  }
  void numbers(GLint location, GLint size, GLenum type, std::uint32_t buffer) const
  {
    if (location >= 0)
    {
      glBindBuffer(GL_ARRAY_BUFFER, buffer);
      glVertexAttribPointer(static_cast<GLuint>(location), size, type,
        type == GL_FLOAT ? GL_FALSE : GL_TRUE, 0, nullptr);
    }
  }

  GLint positions_;
  GLint values_;
  GLint shapes_;
  GLint sizes_;
  GLint heights_;
  bool colours_;
  GpuStream valueStream_;
};

} // namespace pointfront
