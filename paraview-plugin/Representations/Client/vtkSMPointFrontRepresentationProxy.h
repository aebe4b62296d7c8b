/**
 * @class vtkSMPointFrontRepresentationProxy
 * @brief the client's end of a vtkPointFrontRepresentation: asks for further frames while the view
 * is at rest
 *
 * A render never waits for the disk, so a picture becomes complete over several frames, and
 * somebody must ask for them. After each render of its view this object starts a one-shot timer of
 * the view's interactor. When it fires, the last frame is gathered from all processes
 * (vtkPVPointFrontFrame); if one of them has more to show, the interactor's RenderEvent is invoked,
 * which ParaView turns into a still render, or an interactive one while a mouse button is held. It
 * ends when the frame is complete everywhere. What is gathered is what the panel shows of the view.
 * Works without Qt: in the ParaView application, and in a Python client with a window (Interact()),
 * with the builtin and with remote servers. In batch there is no event loop and no timer. Before
 * each render it hides the legends of colours that are drawn as they are.
 *
 * The server manager makes one for every representation of a view, whatever it draws; one that is
 * not the active type stays silent and sends nothing to the server. Client only, main thread.
 */
#ifndef vtkSMPointFrontRepresentationProxy_h
#define vtkSMPointFrontRepresentationProxy_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkSMRepresentationProxy.h"
#include "vtkWeakPointer.h" // for the view

#include <map>
#include <string>
#include <vector>

class vtkPVPointFrontFrame;
class vtkRenderWindowInteractor;
class vtkSMViewProxy;

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkSMPointFrontRepresentationProxy
  : public vtkSMRepresentationProxy
{
public:
  static vtkSMPointFrontRepresentationProxy* New();
  vtkTypeMacro(vtkSMPointFrontRepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Begins to follow the view; what it shows has an input now, and the input has classes.
  void ViewUpdated(vtkSMProxy* view) override;

protected:
  vtkSMPointFrontRepresentationProxy();
  ~vtkSMPointFrontRepresentationProxy() override;

  /// Also makes the page of our settings, if the plugin was loaded without the application's doing
  /// so (pvbatch, Python).
  void CreateVTKObjects() override;

  /// Keeps Quality and the properties that it stands for alike.
  void SetPropertyModifiedFlag(const char* name, int flag) override;

  /// PointsDrawn, NodesDrawn, ProjectedSpacing, LimitedBy and FrameComplete are of all processes,
  /// not of the server's root.
  void UpdatePropertyInformationInternal(vtkSMProperty* property) override;

private:
  vtkSMPointFrontRepresentationProxy(const vtkSMPointFrontRepresentationProxy&) = delete;
  void operator=(const vtkSMPointFrontRepresentationProxy&) = delete;

  /// Asks the server for the classes of the store.
  void GatherClasses();
  void TellClasses();
  /// Enters the classes of the store in the property: those that were switched off as hidden, all
  /// others as shown.
  void ListClasses();
  /// Tells the reader's panel about a store that is built meanwhile.
  void TellStore();
  /// Sets what the panel shows of a frame.
  void TellFrame(vtkPVPointFrontFrame* frame);
  void Follow(vtkSMViewProxy* view);
  void Unfollow();
  /// Whether this is the representation that the view draws now.
  bool IsActive();
  bool IsSessionBusy();
  void StartTimer(int milliseconds);
  void StopTimer();
  void OnRender(vtkObject* view, unsigned long event, void* interactive);
  void OnRendered(vtkObject* view, unsigned long event, void* interactive);
  void OnTimer(vtkObject* interactor, unsigned long event, void* timer);

  std::vector<std::string> Classes; ///< classes of the store
  std::map<std::string, bool> ClassShown; ///< those of this store and of earlier ones
  vtkWeakPointer<vtkSMViewProxy> View;
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  unsigned long StartObserver = 0;
  unsigned long RenderObserver = 0;
  unsigned long TimerObserver = 0;
  bool Agreeing = false; ///< properties are being set here
  int Timer = 0; ///< number of the interactor's timer; 0: none
  int Delay = 0; ///< milliseconds, of the last timer started
};

#endif
