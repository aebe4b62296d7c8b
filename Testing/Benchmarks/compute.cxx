// usage: pointfrontComputeBenchmark STORE.pfront [ROUNDS [POINTS]]
//
// Milliseconds for a picture of the first POINTS points of a cloud, 1280 x 720, as points of one
// pixel and as blended discs, by
//   raster    GL_POINTS into a framebuffer: one pass, or depths and then sums,
//   compute   compute shaders (OpenGL 4.3) on the same buffer: 32-bit atomics on depths, then on
//             colours or sums, and a pass over the picture,
//   opengl    vtkPointFrontMapper, all points, its OpenGL back end,
//   software  the same, its software back end.
// The four take turns while the camera goes around the cloud. raster and compute hold nothing but
// 16 bytes a point: they bound what a back end of their kind could reach. JSON on stdout.

#include "BenchmarkCloud.h"
#include "ComputeBenchmarkShaders.h"

#include "HostVTK.h"
#include "vtkPointFrontMapper.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"
#include "vtkPointFrontStyle.h"

#include POINTFRONT_OPENGL_LOADER

#include <nlohmann/json.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace pointfront;

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

GLuint linked(const std::vector<std::pair<GLenum, std::string>>& stages)
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

GLuint texture(GLenum format)
{
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return name;
}

GLuint framebuffer(GLuint colours, GLuint depths)
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
    using namespace compute_benchmark;
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

struct Cloud
{
  std::vector<PackedPoint> points;
  std::array<double, 3> centre;
  double spacing; ///< metres: as if the points filled their box seen from above
};

Cloud packed(vtkPolyData* data, vtkIdType most)
{
  Cloud cloud;
  double bounds[6];
  data->GetBounds(bounds);
  const vtkIdType count = std::min(most, data->GetNumberOfPoints());
  auto* const colours = vtkUnsignedCharArray::SafeDownCast(data->GetPointData()->GetScalars());
  for (int axis = 0; axis < 3; ++axis)
  {
    cloud.centre[static_cast<std::size_t>(axis)] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
  }
  cloud.points.resize(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    PackedPoint& point = cloud.points[static_cast<std::size_t>(i)];
    const double* const p = data->GetPoint(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point.position[axis] = static_cast<float>(p[axis] - cloud.centre[axis]);
      point.colour[axis] = colours->GetValue(3 * i + static_cast<vtkIdType>(axis));
    }
    point.colour[3] = 255;
  }
  cloud.spacing =
    std::sqrt((bounds[1] - bounds[0]) * (bounds[3] - bounds[2]) / static_cast<double>(count));
  return cloud;
}

/// From coordinates relative to the centre to clip space, by rows.
std::array<float, 16> clipMatrix(vtkRenderer* renderer, const std::array<double, 3>& centre)
{
  vtkMatrix4x4* const matrix = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    static_cast<double>(width) / height, -1.0, 1.0);
  std::array<float, 16> result;
  for (int row = 0; row < 4; ++row)
  {
    double moved = matrix->GetElement(row, 3);
    for (int column = 0; column < 3; ++column)
    {
      const double element = matrix->GetElement(row, column);
      moved += element * centre[static_cast<std::size_t>(column)];
      result[static_cast<std::size_t>(4 * row + column)] = static_cast<float>(element);
    }
    result[static_cast<std::size_t>(4 * row + 3)] = static_cast<float>(moved);
  }
  return result;
}

double millisecondsOf(const std::function<void()>& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
    .count();
}

/// Share of the pixels in which two pictures differ by more than 8 in a channel.
double differing(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b)
{
  GLuint count = 0;
  for (GLuint i = 0; i < pixels; ++i)
  {
    int most = 0;
    for (GLuint k = 0; k < 3; ++k)
    {
      most = std::max(most, std::abs(int(a[4 * i + k]) - int(b[4 * i + k])));
    }
    count += most > 8 ? 1 : 0;
  }
  return static_cast<double>(count) / pixels;
}

/// VTK remembers what it set.
void leaveToVTK(vtkRenderWindow* window)
{
  glUseProgram(0);
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  glDepthFunc(GL_LEQUAL);
  vtkOpenGLState* const state = vtkOpenGLRenderWindow::SafeDownCast(window)->GetState();
  state->Reset();
  state->ResetFramebufferBindings();
}

std::vector<unsigned char> pictureOf(vtkRenderWindow* window)
{
  vtkNew<vtkUnsignedCharArray> rgba;
  window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 1, rgba);
  return { rgba->GetPointer(0), rgba->GetPointer(0) + rgba->GetNumberOfValues() };
}

std::string styleOf(double metres)
{
  const std::string technique = metres == 0.0
    ? R"("technique": "points", "size": {"mode": "fixed", "px": 1})"
    : R"("technique": "splats", "blended": true, "orientation": "view", "size": )"
      R"({"mode": "fixed", "metres": )" +
      std::to_string(2.0 * metres) + "}";
  return "{\"default\": {" + technique + "}}";
}

/// The four ways of drawing one cloud, and the camera that goes around it.
class Race
{
public:
  Race(vtkPointFrontReader* reader, const Cloud& cloud)
    : cloud_(cloud)
  {
    mapper_->SetInputConnection(reader->GetOutputPort());
    mapper_->SetScalarModeToUsePointFieldData();
    mapper_->SelectColorArray("rgb");
    mapper_->SetTargetError(0.001);
    mapper_->SetPointBudget(static_cast<vtkIdType>(cloud.points.size()));
    mapper_->CompleteOn();
    mapper_->SetStyle(style_);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper_);
    actor->GetProperty()->LightingOff();
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(width, height);
    window_->AddRenderer(renderer_);
    renderer_->AddActor(actor);
    camera_ = renderer_->GetActiveCamera();
    camera_->SetPosition(1.0, -1.0, 1.0);
    camera_->SetFocalPoint(0.0, 0.0, 0.0);
    camera_->SetViewUp(0.0, 0.0, 1.0);
    renderer_->ResetCamera(mapper_->GetBounds());
    camera_->Zoom(1.5);
    window_->Render();
    window_->MakeCurrent();
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (10 * major + minor < 43)
    {
      fail("the driver has OpenGL " + std::to_string(major) + "." + std::to_string(minor) +
        "; compute shaders need 4.3");
    }
    raw_ = std::make_unique<RawScene>(cloud.points);
  }

  /// `metres`: of a disc's radius; 0: points of one pixel.
  nlohmann::ordered_json run(double metres, int rounds)
  {
    if (!style_->LoadJSON(styleOf(metres)))
    {
      fail("the style is refused");
    }
    times_.clear();
    rawApart_ = backendsApart_ = 0.0;
    for (int round = 0; round <= rounds; ++round)
    {
      isCounted_ = round > 0; // the first one uploads and compiles
      camera_->Azimuth(2.0);
      renderer_->ResetCameraClippingRange(mapper_->GetBounds());
      runRaw(static_cast<float>(metres));
      runMapper();
    }
    nlohmann::ordered_json result;
    for (auto& [name, ms] : times_)
    {
      std::sort(ms.begin(), ms.end());
      result[name] = { { "median_ms", ms[ms.size() / 2] }, { "min_ms", ms.front() } };
    }
    result["points drawn by the mapper"] = mapper_->GetLastPointsDrawn();
    result["pixels in which raster and compute differ"] = rawApart_;
    result["pixels in which the mapper's back ends differ"] = backendsApart_;
    return result;
  }

private:
  void measure(const std::string& name, const std::function<void()>& work)
  {
    const double time = millisecondsOf(work);
    if (isCounted_)
    {
      times_[name].push_back(time);
    }
  }

  void runRaw(float metres)
  {
    window_->MakeCurrent();
    const std::array<float, 16> matrix = clipMatrix(renderer_, cloud_.centre);
    measure("raster", [&] { raw_->raster(matrix, metres); });
    const std::vector<unsigned char> rastered = raw_->read();
    measure("compute", [&] { raw_->compute(matrix, metres); });
    rawApart_ = std::max(rawApart_, differing(rastered, raw_->read()));
    leaveToVTK(window_);
  }

  void runMapper()
  {
    std::vector<unsigned char> pictures[2];
    for (const int backend : { 0, 1 })
    {
      backend == 0 ? mapper_->SetBackendToOpenGL() : mapper_->SetBackendToSoftware();
      camera_->Azimuth(-1.0); // brings its arrays; a view at rest would not be drawn again
      window_->Render();
      camera_->Azimuth(1.0);
      measure(backend == 0 ? "opengl" : "software", [&] { window_->Render(); });
      pictures[backend] = pictureOf(window_);
    }
    backendsApart_ = std::max(backendsApart_, differing(pictures[0], pictures[1]));
  }

  const Cloud& cloud_;
  vtkNew<vtkPointFrontStyle> style_;
  vtkNew<vtkPointFrontMapper> mapper_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkCamera* camera_ = nullptr;
  std::unique_ptr<RawScene> raw_;
  std::map<std::string, std::vector<double>> times_; ///< milliseconds
  bool isCounted_ = false;
  double rawApart_ = 0.0, backendsApart_ = 0.0; ///< shares of the pixels
};

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2 || argc > 4)
  {
    fail("usage: pointfrontComputeBenchmark STORE.pfront [ROUNDS [POINTS]]");
  }
  const int rounds = argc > 2 ? std::stoi(argv[2]) : 7;
  const vtkIdType most = argc > 3 ? std::stoll(argv[3]) : VTK_ID_MAX;
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(argv[1]);
  reader->SetOverviewPoints(0);
  reader->UpdateInformation();
  if (reader->GetStore() == nullptr)
  {
    fail(std::string(argv[1]) + ": cannot be opened");
  }
  reader->GetStore()->SetHostMemoryBudget(vtkTypeInt64(4) << 30);
  const Cloud cloud = packed(allPoints(*reader->GetStore()->GetStore()), most);
  Race race(reader, cloud);
  nlohmann::ordered_json result;
  result["driver"] = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  result["points"] = cloud.points.size();
  result["points of one pixel"] = race.run(0.0, rounds);
  result["blended discs"] = race.run(cloud.spacing, rounds);
  std::printf("%s\n", result.dump(2).c_str());
  return 0;
}
