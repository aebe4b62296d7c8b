#pragma once

#include "OpenGLFunctions.h"

#include <vtkOpenGLState.h>

namespace pointfront
{

/// Saves the state of a window that drawing into our own targets changes, and restores it.
class TargetState
{
public:
  explicit TargetState(vtkOpenGLState* state)
    : state_(state)
    , viewport_(state)
    , depthMask_(state)
    , depthFunction_(state)
    , colourMask_(state)
    , blending_(state)
    , blend_(state, GL_BLEND)
    , depthTest_(state, GL_DEPTH_TEST)
    , scissor_(state)
    , scissorTest_(state, GL_SCISSOR_TEST)
    , culling_(state, GL_CULL_FACE)
  {
    state_->PushFramebufferBindings();
    state_->vtkglDisable(GL_SCISSOR_TEST);
    state_->vtkglDisable(GL_CULL_FACE);
    state_->vtkglDisable(GL_BLEND);
    state_->vtkglDepthMask(GL_TRUE);
    state_->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_PROGRAM_POINT_SIZE);
  }
  ~TargetState()
  {
    glDisable(GL_PROGRAM_POINT_SIZE);
    state_->PopFramebufferBindings();
  }
  TargetState(const TargetState&) = delete;
  TargetState& operator=(const TargetState&) = delete;

private:
  vtkOpenGLState* state_;
  vtkOpenGLState::ScopedglViewport viewport_;
  vtkOpenGLState::ScopedglDepthMask depthMask_;
  vtkOpenGLState::ScopedglDepthFunc depthFunction_;
  vtkOpenGLState::ScopedglColorMask colourMask_;
  vtkOpenGLState::ScopedglBlendFuncSeparate blending_;
  vtkOpenGLState::ScopedglEnableDisable blend_;
  vtkOpenGLState::ScopedglEnableDisable depthTest_;
  vtkOpenGLState::ScopedglScissor scissor_;
  vtkOpenGLState::ScopedglEnableDisable scissorTest_;
  vtkOpenGLState::ScopedglEnableDisable culling_;
};

} // namespace pointfront
