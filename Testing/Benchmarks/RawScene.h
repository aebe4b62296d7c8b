#pragma once

#include "BenchmarkCloud.h"
#include "ComputeBenchmarkShaders.h"

#include "HostVTK.h"

#include POINTFRONT_OPENGL_LOADER

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// Points drawn by raster and by compute shaders, without a mapper: for compute.cxx.
namespace compute_benchmark
{

using pointfront::fail;

constexpr int width = 1280;
constexpr int height = 720;
constexpr GLuint pixels = width * height;
constexpr GLuint chunk = 1 << 22; // points; a buffer of shaders may have no more than 128 MiB
constexpr GLuint group = 256; // points

struct PackedPoint
{
  std::array<float, 3> position; // from the centre of the cloud
  std::array<unsigned char, 4> colour;
};

inline GLuint linked(const std::vector<std::pair<GLenum, std::string>>& stages)
{
  const GLuint program = glCreateProgram();
  for (const auto& [kind, text] : stages)
  {
    const GLuint shader = glCreateShader(kind);
    const char* const source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == 0)
  {
    char log[4096] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    fail(log);
  }
  return program;
}

inline GLuint texture(GLenum format)
{
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return name;
}

inline GLuint framebuffer(GLuint colours, GLuint depths)
{
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colours, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depths, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
  {
    fail("a framebuffer is not complete");
  }
  return name;
}

/// The cloud on the GPU, and both ways of drawing it without a mapper.
class RawScene
{
public:
  explicit RawScene(const std::vector<PackedPoint>& points)
    : count_(static_cast<GLuint>(points.size()))
  {
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glGenBuffers(1, &points_);
    glBindBuffer(GL_ARRAY_BUFFER, points_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(PackedPoint)),
      points.data(), GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(PackedPoint), nullptr);
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(PackedPoint),
      reinterpret_cast<void*>(offsetof(PackedPoint, colour)));
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glGenVertexArrays(1, &none_);
    for (GLuint* buffer : { &nearest_, &sums_ })
    {
      glGenBuffers(1, buffer);
      glBindBuffer(GL_SHADER_STORAGE_BUFFER, *buffer);
      glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(pixels) * (buffer == &sums_ ? 16 : 4),
        nullptr, GL_DYNAMIC_COPY);
    }
    sumTexture_ = texture(GL_RGBA16F);
    const GLuint depths = texture(GL_DEPTH_COMPONENT32F);
    picture_ = framebuffer(texture(GL_RGBA8), depths);
    sumTarget_ = framebuffer(sumTexture_, depths);
    const std::string full = header + fullScreen;
    points1_ = linked({ { GL_VERTEX_SHADER, header + view + pointVertex },
      { GL_FRAGMENT_SHADER, header + pointFragment } });
    discs_ = linked({ { GL_VERTEX_SHADER, header + view + discVertex },
      { GL_FRAGMENT_SHADER, header + discFragment } });
    mean_ = linked({ { GL_VERTEX_SHADER, full }, { GL_FRAGMENT_SHADER, header + meanFragment } });
    nearestOf_ = linked({ { GL_COMPUTE_SHADER, header + view + buffers + nearestCompute } });
    coloursOf_ = linked({ { GL_COMPUTE_SHADER, header + view + buffers + coloursCompute } });
    copy_ = linked(
      { { GL_VERTEX_SHADER, full }, { GL_FRAGMENT_SHADER, header + buffers + copyFragment } });
  }

  /// `metres`: of a disc's radius; 0: points of one pixel.
  void raster(const std::array<float, 16>& matrix, float metres) const
  {
    glBindVertexArray(array_);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDisable(GL_BLEND);
    glEnable(GL_PROGRAM_POINT_SIZE);
    clear(picture_);
    if (metres == 0.0f)
    {
      use(points1_, matrix, metres, false);
      glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count_));
      return;
    }
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    use(discs_, matrix, metres, true);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count_));
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindFramebuffer(GL_FRAMEBUFFER, sumTarget_);
    glClear(GL_COLOR_BUFFER_BIT);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    use(discs_, matrix, metres, false);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count_));
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, picture_);
    glDisable(GL_DEPTH_TEST);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sumTexture_);
    use(mean_, matrix, metres, false);
    glBindVertexArray(none_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
  }

  void compute(const std::array<float, 16>& matrix, float metres) const
  {
    const GLuint farthest = 0xffffffffu;
    const GLuint nothing = 0;
    fill(nearest_, 4, farthest);
    fill(sums_, metres == 0.0f ? 4 : 16, nothing);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, nearest_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, sums_);
    for (const GLuint program : { nearestOf_, coloursOf_ })
    {
      use(program, matrix, metres, false);
      for (GLuint first = 0; first < count_; first += chunk)
      {
        const GLuint here = std::min(chunk, count_ - first);
        glUniform1ui(glGetUniformLocation(program, "count"), here);
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, points_,
          GLintptr(first) * GLintptr(sizeof(PackedPoint)),
          GLsizeiptr(here) * GLsizeiptr(sizeof(PackedPoint)));
        glDispatchCompute((here + group - 1) / group, 1, 1);
      }
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    clear(picture_);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    use(copy_, matrix, metres, false);
    glBindVertexArray(none_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  std::vector<unsigned char> read() const
  {
    std::vector<unsigned char> rgba(4 * pixels);
    glBindFramebuffer(GL_FRAMEBUFFER, picture_);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return rgba;
  }

private:
  static void fill(GLuint buffer, GLuint bytesAPixel, GLuint value)
  {
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
    glClearBufferSubData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, 0, GLsizeiptr(pixels) * bytesAPixel,
      GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
  }
  static void clear(GLuint target)
  {
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, width, height);
    glDepthMask(GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClearDepth(1.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
  static void use(GLuint program, const std::array<float, 16>& matrix, float metres, bool shifted)
  {
    glUseProgram(program);
    glUniformMatrix4fv(
      glGetUniformLocation(program, "toClip"), 1, GL_TRUE, matrix.data()); // VTK's is by rows
    glUniform2f(glGetUniformLocation(program, "pictureSize"), width, height);
    glUniform1f(glGetUniformLocation(program, "metres"), metres);
    glUniform1i(glGetUniformLocation(program, "shifted"), shifted ? 1 : 0);
    glUniform1i(glGetUniformLocation(program, "sums"), 0);
  }

  GLuint count_;
  GLuint array_ = 0, none_ = 0, points_ = 0, nearest_ = 0, sums_ = 0;
  GLuint sumTexture_ = 0, picture_ = 0, sumTarget_ = 0;
  GLuint points1_ = 0, discs_ = 0, mean_ = 0, nearestOf_ = 0, coloursOf_ = 0, copy_ = 0;
};

} // namespace compute_benchmark
