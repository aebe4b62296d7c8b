#include "KeptSplats.h"

#include "GpuPool.h"
#include "OpenGLFunctions.h"
#include "RasterItems.h"
#include "SplatRuns.h"
#include "SplatUniforms.h"

#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <glm/matrix.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{

/// As CaptureGS.glsl writes them, one after the other.
struct KeptValue
{
  const char* name;
  GLint size;
};
constexpr KeptValue keptValues[] = { { "keptPlace", 3 }, { "keptRadius", 1 }, { "keptColour", 4 },
  { "keptNormal", 3 }, { "keptId", 2 } };
constexpr GLsizei keptStride = 13 * sizeof(float);

/// Camera space as the shaders have it: the line of sight is z, depths of a parallel view count
/// from its near plane.
glm::dmat4 storeToCamera(const FrameCamera& camera)
{
  glm::dmat4 result = camera.storeToView;
  for (int column = 0; column < 4; ++column)
  {
    result[column][2] = -result[column][2];
  }
  if (camera.parallel)
  {
    const glm::dmat4& clip = camera.viewToClip;
    result[3][2] -= (clip[3][2] + clip[3][3]) / (clip[2][2] + clip[2][3]);
  }
  return result;
}

void setMatrix(vtkShaderProgram* program, const char* name, const glm::dmat4& matrix)
{
  glm::mat4 columns(matrix); // as GL wants them, but the function takes no const
  program->SetUniformMatrix4x4(name, &columns[0][0]);
}

bool sameStyle(const std::shared_ptr<const ResolvedStyle>& a, const ResolvedStyle* b)
{
  return a.get() == b || *a == *b;
}

std::int64_t pointsOf(const DrawRuns& runs)
{
  const auto& stretches = runs.stretches();
  const std::size_t count = stretches.empty() ? 0 : stretches.back().end;
  return std::accumulate(runs.counts(), runs.counts() + count, std::int64_t(0));
}

/// The buffer's points are what a program of kept points reads.
class KeptAttributes
{
public:
  KeptAttributes(vtkShaderProgram* program, std::uint32_t buffer)
  {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    std::size_t offset = 0;
    for (std::size_t i = 0; i < std::size(keptValues); ++i)
    {
      locations_[i] =
        glGetAttribLocation(static_cast<GLuint>(program->GetHandle()), keptValues[i].name);
      if (locations_[i] >= 0)
      {
        const auto location = static_cast<GLuint>(locations_[i]);
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, keptValues[i].size, GL_FLOAT, GL_FALSE, keptStride,
          reinterpret_cast<const void*>(offset)); // NOLINT(performance-no-int-to-ptr): as GL has it
      }
      offset += sizeof(float) * static_cast<std::size_t>(keptValues[i].size);
    }
  }
  ~KeptAttributes()
  {
    for (const GLint location : locations_)
    {
      if (location >= 0)
      {
        glDisableVertexAttribArray(static_cast<GLuint>(location));
      }
    }
    glBindBuffer(GL_ARRAY_BUFFER, 0);
  }
  KeptAttributes(const KeptAttributes&) = delete;
  KeptAttributes& operator=(const KeptAttributes&) = delete;

private:
  GLint locations_[std::size(keptValues)];
};

} // namespace

KeptSplats::~KeptSplats() = default;

std::int64_t KeptSplats::points() const
{
  return std::accumulate(sets_.begin(), sets_.end(), std::int64_t(0),
    [](std::int64_t sum, const Set& set) { return sum + set.points; });
}

void KeptSplats::clear()
{
  for (const Set& set : sets_)
  {
    glDeleteBuffers(1, &set.buffer);
  }
  sets_.clear();
}

/// What is drawn from here on is written to the set's buffer in place of the screen; `most` points.
/// False where GL has no room for it.
bool KeptSplats::begin(Set& set, std::int64_t most)
{
  for (int errors = 0; errors < 16 && glGetError() != GL_NO_ERROR; ++errors)
  {
    // Of others. A lost context never runs out of them.
  }
  glGenBuffers(1, &set.buffer);
  glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, set.buffer);
  glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, static_cast<GLsizeiptr>(most * keptStride), nullptr,
    GL_DYNAMIC_COPY);
  if (glGetError() != GL_NO_ERROR)
  {
    glDeleteBuffers(1, &set.buffer);
    return false;
  }
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, set.buffer);
  glGenQueries(1, &set.query);
  glEnable(GL_RASTERIZER_DISCARD);
  glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, set.query);
  glBeginTransformFeedback(GL_POINTS);
  return true;
}

void KeptSplats::end()
{
  glEndTransformFeedback();
  glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
  glDisable(GL_RASTERIZER_DISCARD);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

void KeptSplats::setLast(vtkShaderProgram* program, const FramePlan& plan, const LastPicture& last)
{
  setMatrix(program, "cameraToLastClip",
    last.camera.storeToClip() * glm::inverse(storeToCamera(plan.camera)));
  const int size[2] = { last.camera.width, last.camera.height };
  program->SetUniform2i("lastSize", size);
  setTexture(program, "lastIds", last.ids);
}

void KeptSplats::setPlaces(vtkShaderProgram* program, const FrameCamera& now) const
{
  const glm::dmat4 change = storeToCamera(now) * glm::inverse(storeToCamera(camera_));
  setMatrix(program, "keptToCamera", change);
  glm::mat3 normals(glm::transpose(glm::inverse(glm::dmat3(change))));
  program->SetUniformMatrix3x3("keptNormals", &normals[0][0]);
}

void KeptSplats::collect(const SplatFrame& frame, SplatTools& tools, const SplatGroups& leaving,
  const FramePlan& plan, const LastPicture& last)
{
  std::vector<Set> old = std::exchange(sets_, {});
  tools.vertices->Bind();
  for (const SplatGroups::Group& group : leaving.groups())
  {
    this->collectGroup(frame, tools, group, plan, last);
  }
  for (std::size_t i = 0; i < old.size(); ++i)
  {
    const Set& model = old[i];
    const auto alike = [&](const Set& other) { return sameStyle(other.style, model.style.get()); };
    if (std::none_of(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(i), alike))
    {
      std::vector<Set> sets;
      std::copy_if(old.begin(), old.end(), std::back_inserter(sets), alike);
      this->collectKept(frame, tools, sets, model, plan, last);
    }
  }
  tools.vertices->Release();
  if (last.ids->GetTextureUnit() >= 0)
  {
    last.ids->Deactivate();
  }
  for (Set& set : sets_)
  {
    GLuint points = 0;
    glGetQueryObjectuiv(set.query, GL_QUERY_RESULT, &points);
    glDeleteQueries(1, &set.query);
    set.points = points;
  }
  std::swap(old, sets_);
  this->clear();
  for (Set& set : old)
  {
    if (set.points > 0)
    {
      sets_.push_back(std::move(set));
    }
    else
    {
      glDeleteBuffers(1, &set.buffer);
    }
  }
  camera_ = plan.camera;
}

void KeptSplats::collectGroup(const SplatFrame& frame, SplatTools& tools,
  const SplatGroups::Group& group, const FramePlan& plan, const LastPicture& last)
{
  if (group.first->passes.walls())
  {
    return;
  }
  SplatVariant variant = variantOf(group, SplatTarget::Parts(), false);
  vtkShaderProgram* const program = tools.programs.useCapture(frame.window, variant);
  const auto batch = std::find_if(plan.batches.begin(), plan.batches.end(),
    [&](const DrawBatch& each) { return sameStyle(each.style, group.first->style); });
  Set set;
  const std::int64_t pixels = std::int64_t(last.camera.width) * last.camera.height;
  if (!program || batch == plan.batches.end() || !begin(set, std::min(pixels, pointsOf(group.all))))
  {
    return;
  }
  set.style = batch->style;
  set.radius = variant.radius;
  set.quads = group.quads;
  setLast(program, plan, last);
  drawSplatRuns(frame, tools.lastRecords, program, variant, group, group.all);
  end();
  sets_.push_back(std::move(set));
}

SplatVariant KeptSplats::variantOfKept(const Set& set, bool parallel)
{
  SplatVariant variant;
  variant.kept = true;
  variant.parallel = parallel;
  const bool measured = set.radius != RadiusSource::Pixels && set.radius != RadiusSource::World;
  variant.radius = measured ? RadiusSource::Node : set.radius;
  return variant;
}

void KeptSplats::collectKept(const SplatFrame& frame, SplatTools& tools,
  const std::vector<Set>& kept, const Set& model, const FramePlan& plan, const LastPicture& last)
{
  SplatVariant variant = variantOfKept(model, plan.camera.parallel);
  variant.radius = RadiusSource::Node; // handed on as it is
  vtkShaderProgram* const program = tools.programs.useCapture(frame.window, variant);
  const std::int64_t most = std::accumulate(kept.begin(), kept.end(), std::int64_t(0),
    [](std::int64_t sum, const Set& set) { return sum + set.points; });
  const bool planned = std::any_of(plan.batches.begin(), plan.batches.end(),
    [&](const DrawBatch& each) { return sameStyle(each.style, model.style.get()); });
  Set set;
  if (!program || !planned || !begin(set, most))
  {
    return;
  }
  set.style = model.style;
  set.radius = model.radius;
  set.quads = std::any_of(kept.begin(), kept.end(), [](const Set& each) { return each.quads; });
  setLast(program, plan, last);
  this->setPlaces(program, plan.camera);
  program->SetUniformf("keptShare", 1.0f);
  for (const Set& each : kept)
  {
    const KeptAttributes bound(program, each.buffer);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(each.points));
  }
  end();
  sets_.push_back(std::move(set));
}

void KeptSplats::draw(const SplatFrame& frame, SplatTools& tools, const SplatGroups& groups,
  const SplatTarget::Parts& parts, bool second, vtkTextureObject* seenDepths)
{
  for (const Set& set : sets_)
  {
    const auto group = std::find_if(groups.groups().begin(), groups.groups().end(),
      [&](const SplatGroups::Group& each)
      { return !each.first->passes.walls() && sameStyle(set.style, each.first->style); });
    if (group == groups.groups().end() || (second && !group->first->passes.blended))
    {
      continue;
    }
    SplatVariant variant = variantOf(*group, parts, second);
    const SplatVariant own = variantOfKept(set, variant.parallel);
    variant.kept = true;
    variant.marked = variant.shaped = variant.normals = false;
    variant.colour = own.colour;
    variant.radius = own.radius;
    variant.quads = variant.quads || set.quads;
    vtkShaderProgram* const program = tools.programs.use(frame.window, variant);
    if (!program)
    {
      continue;
    }
    const RasterItem& item = *group->first;
    setSplatUniforms(program, *group->items, item, second);
    this->setPlaces(program, group->items->plan().camera);
    program->SetUniformf(
      "keptShare", second ? item.passes.secondRadius / item.passes.firstRadius : 1.0f);
    setTexture(program, "seenDepths", seenDepths);
    const KeptAttributes bound(program, set.buffer);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(set.points));
    if (second)
    {
      seenDepths->Deactivate();
    }
  }
}

} // namespace pointfront
