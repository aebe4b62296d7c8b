#ifndef pointfront_OpenGLFunctions_h
#define pointfront_OpenGLFunctions_h

/// OpenGL's functions and constants, from the loader that the host's VTK brings. The window loads
/// them: call none before vtkOpenGLRenderWindow has made its context.

#include "HostVTK.h"

#include POINTFRONT_OPENGL_LOADER

#endif
