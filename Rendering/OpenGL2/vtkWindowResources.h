/**
 * @class vtkWindowResources
 * @brief tells when a window's GL context goes
 *
 * VTK's windows tell objects that are registered with them; the class that it takes is not
 * installed. A vtkOpenGLPolyDataMapper has one: this is a mapper without input for its sake.
 */
#ifndef vtkWindowResources_h
#define vtkWindowResources_h

#include "vtkOpenGLPolyDataMapper.h"

#include <functional>

class vtkPolyData;

class vtkWindowResources : public vtkOpenGLPolyDataMapper
{
public:
  static vtkWindowResources* New();
  vtkTypeMacro(vtkWindowResources, vtkOpenGLPolyDataMapper);

  /// Registers with the renderer's window.
  void Enter(vtkRenderer* renderer, vtkActor* actor);
  /// Called while the context is there and current.
  void SetReleaseFunction(std::function<void()> release) { this->Released = std::move(release); }

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkWindowResources();
  ~vtkWindowResources() override;

private:
  vtkWindowResources(const vtkWindowResources&) = delete;
  void operator=(const vtkWindowResources&) = delete;

  std::function<void()> Released;
  vtkNew<vtkPolyData> NoInput;
};

#endif
