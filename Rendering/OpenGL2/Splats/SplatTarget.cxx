#include "SplatTarget.h"

#include "OpenGLFunctions.h"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkTextureObject.h>

#include <algorithm>

namespace pointfront
{
namespace
{

/// Pixels of targets that one cloud alone draws into: four of full HD, 300 to 560 MB.
constexpr std::int64_t mostOwnPixels = std::int64_t(1) << 23;

constexpr float nothing[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
/// Who is seen where nothing is: all is behind it.
constexpr float nowhere[4] = { -3.4e38f, -3.4e38f, 0.0f, 0.0f };

void allocate(vtkOpenGLRenderWindow* window, vtkTextureObject* texture,
  const SplatTarget::Parts& parts, int components, int type)
{
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->Allocate2D(static_cast<unsigned int>(parts.width),
    static_cast<unsigned int>(parts.height), components, type);
}

/// To all of the first outputs. VTK keeps in mind what it set last for whichever framebuffer is
/// bound, and may set nothing: what a framebuffer draws to is its own state.
void bind(vtkOpenGLFramebufferObject* framebuffer, unsigned int outputs)
{
  framebuffer->Bind();
  constexpr GLenum all[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2,
    GL_COLOR_ATTACHMENT3 };
  glDrawBuffers(static_cast<GLsizei>(outputs), all);
}

/// A rectangle of a framebuffer becomes that of a texture of its size. What the framebuffer reads
/// from is as before when VTK is called again: it keeps that in mind, too, and may compare.
void copyTo(vtkTextureObject* texture, vtkOpenGLFramebufferObject* from, unsigned int attachment,
  const PixelRectangle& r)
{
  from->Bind();
  texture->Activate();
  GLint before = GL_NONE;
  glGetIntegerv(GL_READ_BUFFER, &before);
  glReadBuffer(attachment);
  glCopyTexSubImage2D(GL_TEXTURE_2D, 0, r.left, r.bottom, r.left, r.bottom, r.width(), r.height());
  glReadBuffer(static_cast<GLenum>(before));
  texture->Deactivate();
}

} // namespace

SplatTarget::SplatTarget() = default;
SplatTarget::~SplatTarget() = default;

bool SplatTarget::has(const Parts& parts) const
{
  return ready_ && parts.width == parts_.width && parts.height == parts_.height &&
    parts.lit == parts_.lit && parts.ids == parts_.ids && parts.blended == parts_.blended &&
    parts.looks == parts_.looks && parts.picture == parts_.picture;
}

bool SplatTarget::prepare(vtkOpenGLRenderWindow* window, const Parts& parts)
{
  if (has(parts))
  {
    return true;
  }
  release(window);
  parts_ = parts;
  allocate(window, seenColours_, parts, 4, VTK_UNSIGNED_CHAR);
  allocate(window, seenDepths_, parts, parts.looks ? 4 : 2, VTK_FLOAT);
  depthBuffer_->SetContext(window);
  depthBuffer_->AllocateDepth(static_cast<unsigned int>(parts.width),
    static_cast<unsigned int>(parts.height), vtkTextureObject::Float32);
  if (parts.lit)
  {
    allocate(window, normals_, parts, 4, VTK_FLOAT);
  }
  if (parts.ids)
  {
    allocate(window, ids_, parts, 2, VTK_FLOAT);
  }
  if (parts.blended)
  {
    allocate(window, sums_, parts, 4, VTK_FLOAT);
  }
  if (parts.picture)
  {
    allocate(window, pictureColour_, parts, 4, VTK_UNSIGNED_CHAR);
    allocate(window, pictureDepth_, parts, 2, VTK_FLOAT);
  }
  ready_ = attach(window);
  return ready_;
}

bool SplatTarget::attach(vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* const state = window->GetState();
  state->PushFramebufferBindings();
  const auto isWhole = [](vtkOpenGLFramebufferObject* framebuffer)
  { return framebuffer->CheckFrameBufferStatus(GL_FRAMEBUFFER) != 0; };
  seen_->SetContext(window);
  seen_->Bind();
  unsigned int next = 0;
  seen_->AddColorAttachment(next++, seenColours_);
  seen_->AddColorAttachment(next++, seenDepths_);
  if (parts_.lit)
  {
    seen_->AddColorAttachment(next++, normals_);
  }
  if (parts_.ids)
  {
    seen_->AddColorAttachment(next++, ids_);
  }
  seen_->AddDepthAttachment(depthBuffer_);
  bool whole = isWhole(seen_);
  if (parts_.blended)
  {
    summed_->SetContext(window);
    summed_->Bind();
    summed_->AddColorAttachment(0, sums_);
    whole = whole && isWhole(summed_);
  }
  if (parts_.picture)
  {
    picture_->SetContext(window);
    picture_->Bind();
    picture_->AddColorAttachment(0, pictureColour_);
    picture_->AddColorAttachment(1, pictureDepth_);
    whole = whole && isWhole(picture_);
  }
  state->PopFramebufferBindings();
  return whole;
}

void SplatTarget::beginSeen(bool empty)
{
  const auto outputs = static_cast<unsigned int>(2 + int(parts_.lit) + int(parts_.ids));
  bind(seen_, outputs);
  constexpr float farthest = 1.0f;
  for (unsigned int output = 0; empty && output < outputs; ++output)
  {
    glClearBufferfv(GL_COLOR, static_cast<GLint>(output), output == 1 ? nowhere : nothing);
  }
  if (empty)
  {
    glClearBufferfv(GL_DEPTH, 0, &farthest);
  }
}

void SplatTarget::beginSums(bool empty)
{
  bind(summed_, 1);
  if (empty)
  {
    glClearBufferfv(GL_COLOR, 0, nothing);
  }
}

void SplatTarget::keepDepths(vtkOpenGLRenderWindow* window)
{
  if (lastDepths_->GetHandle() == 0)
  {
    allocate(window, lastDepths_, parts_, 1, VTK_FLOAT);
  }
  copyTo(lastDepths_, seen_, GL_COLOR_ATTACHMENT1, { 0, 0, parts_.width, parts_.height });
}

void SplatTarget::follow(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle)
{
  if (earlierDepths_->GetHandle() == 0)
  {
    allocate(window, earlierDepths_, parts_, 1, VTK_FLOAT);
    allocate(window, earlierIds_, parts_, 2, VTK_FLOAT);
  }
  const GLenum ids = parts_.lit ? GL_COLOR_ATTACHMENT3 : GL_COLOR_ATTACHMENT2;
  copyTo(earlierDepths_, seen_, GL_COLOR_ATTACHMENT1, rectangle);
  copyTo(earlierIds_, seen_, ids, rectangle);
  beginSeen(false);
  constexpr float farthest = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void SplatTarget::takeSums(SplatTarget& other)
{
  copyTo(sums_, other.summed_, GL_COLOR_ATTACHMENT0, { 0, 0, parts_.width, parts_.height });
}

void SplatTarget::beginPicture()
{
  bind(picture_, 2);
}

void SplatTarget::release(vtkOpenGLRenderWindow* window)
{
  ready_ = false;
  owner_ = nullptr;
  for (vtkOpenGLFramebufferObject* framebuffer :
    { seen_.GetPointer(), summed_.GetPointer(), picture_.GetPointer() })
  {
    framebuffer->ReleaseGraphicsResources(window);
  }
  for (vtkTextureObject* texture : { seenColours_.GetPointer(), seenDepths_.GetPointer(),
         depthBuffer_.GetPointer(), normals_.GetPointer(), ids_.GetPointer(), sums_.GetPointer(),
         lastDepths_.GetPointer(), earlierDepths_.GetPointer(), earlierIds_.GetPointer(),
         pictureColour_.GetPointer(), pictureDepth_.GetPointer() })
  {
    texture->ReleaseGraphicsResources(window);
  }
}

std::shared_ptr<SplatTarget> SplatTargets::of(const void* owner, std::int64_t pixels)
{
  own_.erase(std::remove_if(
               own_.begin(), own_.end(), [&](const Own& each) { return each.target.expired(); }),
    own_.end());
  std::int64_t others = 0;
  std::shared_ptr<SplatTarget> mine;
  for (Own& each : own_)
  {
    if (each.owner == owner)
    {
      mine = each.target.lock();
      each.pixels = pixels;
    }
    others += each.owner == owner ? 0 : each.pixels;
  }
  if (!mine && (own_.empty() || others + pixels <= mostOwnPixels))
  {
    mine = std::make_shared<SplatTarget>();
    own_.push_back({ owner, pixels, mine });
  }
  if (!mine)
  {
    mine = shared_.lock();
    mine = mine ? mine : std::make_shared<SplatTarget>();
    shared_ = mine;
  }
  return mine;
}

} // namespace pointfront
