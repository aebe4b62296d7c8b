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
/// Each frame of a motion may add one; then they are put together.
constexpr std::size_t mostSets = 16;

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
  known_.clear();
}

void KeptSplats::leaveOutKnown(FramePlan& leaving)
{
  for (DrawBatch& batch : leaving.batches)
  {
    std::vector<PlanItem> fresh;
    for (const PlanItem& item : batch.items)
    {
      const auto known = known_.find(item.node->node);
      const Range range = known == known_.end() ? Range{ item.last, item.last } : known->second;
      PlanItem part = item; // before what is known, then behind it
      part.last = std::min(item.last, range.first);
      part.first < part.last ? fresh.push_back(part) : void();
      part.first = std::max(item.first, range.last);
      part.last = item.last;
      part.first < part.last ? fresh.push_back(part) : void();
    }
    batch.items = std::move(fresh);
  }
  for (const DrawBatch& batch : leaving.batches) // several may have the same node
  {
    for (const PlanItem& item : batch.items)
    {
      const auto [known, isNew] = known_.insert({ item.node->node, { item.first, item.last } });
      Range& range = known->second;
      range = { std::min(range.first, item.first), std::max(range.last, item.last) };
    }
  }
}

/// From here on drawing goes to the set's buffer in place of the screen; `most` points.
/// False where GL has no room for it.
bool KeptSplats::begin(Set& set, std::int64_t most)
{
  for (int errors = 0; errors < 16 && glGetError() != GL_NO_ERROR; ++errors)
  {
    // Errors of earlier calls. A lost context never runs out of them.
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

/// Learns how many points were captured; the buffer becomes as large as these.
void KeptSplats::count(Set& set)
{
  GLuint points = 0;
  glGetQueryObjectuiv(set.query, GL_QUERY_RESULT, &points);
  glDeleteQueries(1, &set.query);
  set.query = 0;
  set.points = points;
  GLuint fitting = 0;
  const auto bytes = static_cast<GLsizeiptr>(set.points * keptStride);
  glGenBuffers(1, &fitting);
  glBindBuffer(GL_COPY_READ_BUFFER, set.buffer);
  glBindBuffer(GL_COPY_WRITE_BUFFER, fitting);
  glBufferData(GL_COPY_WRITE_BUFFER, bytes, nullptr, GL_STATIC_DRAW);
  glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, bytes);
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  glDeleteBuffers(1, &set.buffer);
  set.buffer = fitting;
}

void KeptSplats::dropEmpty()
{
  const auto isEmpty = [](const Set& set)
  {
    if (set.points == 0)
    {
      glDeleteBuffers(1, &set.buffer);
    }
    return set.points == 0;
  };
  sets_.erase(std::remove_if(sets_.begin(), sets_.end(), isEmpty), sets_.end());
}

void KeptSplats::setLast(vtkShaderProgram* program, const FramePlan& plan, const LastPicture& last)
{
  setMatrix(program, "cameraToLastClip",
    last.camera.storeToClip() * glm::inverse(storeToCamera(plan.camera)));
  const int size[2] = { last.camera.width, last.camera.height };
  program->SetUniform2i("lastSize", size);
  setTexture(program, "lastIds", last.ids);
}

void KeptSplats::setPlaces(vtkShaderProgram* program, const Set& set, const FrameCamera& now)
{
  const glm::dmat4 change = storeToCamera(now) * glm::inverse(storeToCamera(set.camera));
  setMatrix(program, "keptToCamera", change);
  glm::mat3 normals(glm::transpose(glm::inverse(glm::dmat3(change))));
  program->SetUniformMatrix3x3("keptNormals", &normals[0][0]);
}

/// The plan's own styles; what has none goes.
void KeptSplats::adopt(const FramePlan& plan)
{
  for (Set& set : sets_)
  {
    const auto batch = std::find_if(plan.batches.begin(), plan.batches.end(),
      [&](const DrawBatch& each) { return sameStyle(each.style, set.style.get()); });
    set.points = batch == plan.batches.end() ? 0 : set.points;
    set.style = batch == plan.batches.end() ? set.style : batch->style;
  }
  dropEmpty();
}

void KeptSplats::collect(const SplatFrame& frame, SplatTools& tools, const SplatGroups& leaving,
  const FramePlan& plan, const LastPicture& last)
{
  adopt(plan);
  tools.vertices->Bind();
  const std::size_t before = sets_.size();
  for (const SplatGroups::Group& group : leaving.groups())
  {
    this->collectGroup(frame, tools, group, plan, last);
  }
  std::for_each(sets_.begin() + static_cast<std::ptrdiff_t>(before), sets_.end(), count);
  dropEmpty();
  const std::int64_t pixels = std::int64_t(plan.camera.width) * plan.camera.height;
  const bool tooMany = points() > pixels;
  if (tooMany || sets_.size() > mostSets)
  {
    gather(frame, tools, plan, last, !tooMany);
  }
  while (points() > pixels) // the latest stay
  {
    sets_.front().points = 0;
    dropEmpty();
  }
  tools.vertices->Release();
  if (last.ids->GetTextureUnit() >= 0)
  {
    last.ids->Deactivate();
  }
}

void KeptSplats::gather(const SplatFrame& frame, SplatTools& tools, const FramePlan& plan,
  const LastPicture& last, bool all)
{
  std::vector<Set> old = std::exchange(sets_, {});
  while (!old.empty())
  {
    const std::shared_ptr<const ResolvedStyle> style = old.front().style;
    const auto others = std::stable_partition(
      old.begin(), old.end(), [&](const Set& set) { return sameStyle(set.style, style.get()); });
    std::vector<Set> alike(old.begin(), others);
    old.erase(old.begin(), others);
    Set one = gathered(frame, tools, alike, plan, last, all);
    for (const Set& set : alike)
    {
      glDeleteBuffers(1, &set.buffer);
    }
    one.buffer != 0 ? sets_.push_back(std::move(one)) : void();
  }
  dropEmpty();
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
  set.camera = plan.camera;
  setLast(program, plan, last);
  program->SetUniformi("takesAll", 0);
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

/// Without a buffer: GL has no room for it.
KeptSplats::Set KeptSplats::gathered(const SplatFrame& frame, SplatTools& tools,
  const std::vector<Set>& kept, const FramePlan& plan, const LastPicture& last, bool all) const
{
  const Set& model = kept.front();
  SplatVariant variant = variantOfKept(model, plan.camera.parallel);
  variant.radius = RadiusSource::Node; // handed on as it is
  vtkShaderProgram* const program = tools.programs.useCapture(frame.window, variant);
  const std::int64_t most = std::accumulate(kept.begin(), kept.end(), std::int64_t(0),
    [](std::int64_t sum, const Set& set) { return sum + set.points; });
  Set set;
  if (!program || !begin(set, most))
  {
    return Set();
  }
  set.style = model.style;
  set.radius = model.radius;
  set.quads = std::any_of(kept.begin(), kept.end(), [](const Set& each) { return each.quads; });
  set.camera = plan.camera;
  setLast(program, plan, last);
  program->SetUniformi("takesAll", all ? 1 : 0);
  program->SetUniformf("keptShare", 1.0f);
  for (const Set& each : kept)
  {
    setPlaces(program, each, plan.camera);
    const KeptAttributes bound(program, each.buffer);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(each.points));
  }
  end();
  count(set);
  return set;
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
    setPlaces(program, set, group->items->plan().camera);
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
