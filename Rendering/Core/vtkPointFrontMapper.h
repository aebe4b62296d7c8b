/**
 * @class vtkPointFrontMapper
 * @brief draws a point store that may be larger than memory, at an error and inside budgets that
 * the user chooses
 *
 * Connect it to a vtkPointFrontReader (or to anything that keeps the reader's field data) and give
 * it to a vtkActor. On every render it moves the store's rendering front (Richter & Doellner 2010,
 * section 3.2.1) towards the view, asks for the nodes that are missing and draws what is there: a
 * frame never waits for the disk unless Complete is on. When new nodes arrive it invokes
 * vtkCommand::UpdateDataEvent (from the main thread, see RenderWhenDataArrives()).
 *
 * The OpenGL side comes by VTK's object factory from PointFront::RenderingOpenGL2.
 *
 * Colour: as any vtkMapper. ScalarVisibility, ScalarMode, SelectColorArray/ArrayName,
 * ArrayComponent, ColorMode, LookupTable and ScalarRange choose it; arrays are named as the store's
 * attributes are ("rgb", "intensity", "classification", "elevation" ...). With ColorMode default,
 * "rgb" is drawn as it is; every other attribute goes through the lookup table. Three more names
 * can be chosen of what the store has: "elevation" (z), "horizontality" (of "normal": 1 on flat
 * roofs, 0 on walls) and "global_height" (0 to 1: how high among the points of its class, in a
 * store with a tree for each class; Richter, Discher & Doellner 2015, section 3.1). A lookup table
 * of vector mode RGB colours shows vectors over its range as colours: -1 to 1 for "normal".
 */
#ifndef vtkPointFrontMapper_h
#define vtkPointFrontMapper_h

#include "pointfrontRenderingCoreModule.h" // for the export macro
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h" // for the store

#include <cstdint> // for counts
#include <memory> // for its content
#include <string> // for names
// for the views
#include <vector> // for layers

class vtkPointFrontStore;
class vtkPointFrontStyle;
class vtkRenderWindowInteractor;
class vtkWindow;
namespace pointfront
{
struct FrameDemand;
struct FramePlan;
struct FrameStatistics;
struct LayerStyling;
struct PlanRequest;
struct StyleSheet;
} // namespace pointfront

class POINTFRONTRENDERINGCORE_EXPORT vtkPointFrontMapper : public vtkPolyDataMapper
{
public:
  static vtkPointFrontMapper* New();
  vtkTypeMacro(vtkPointFrontMapper, vtkPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The projected point spacing that a still view refines to, in pixels. Default 1, clamped to
   * [0.01, 1000].
   */
  vtkSetClampMacro(TargetError, double, 0.01, 1000.0);
  vtkGetMacro(TargetError, double);
  ///@}

  ///@{
  /**
   * Most points drawn at a time (they are in GPU memory), over all clouds of a window: several
   * mappers in one window share it, the largest errors on screen first. Default 5,000,000; 0: no
   * limit but memory.
   */
  vtkSetClampMacro(PointBudget, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(PointBudget, vtkIdType);
  ///@}

  ///@{
  /**
   * Most bytes of GPU memory for points, over all clouds of a window. A view that needs more
   * settles at the best error that fits (LastLimitedByGPUMemory). Counted is what the buffers take,
   * filled or not, not the points in them; a frame in which they grow takes no more than that
   * either, nor does the first one after it was lowered. Default 0: no limit but PointBudget.
   */
  vtkSetClampMacro(GPUMemoryBudget, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(GPUMemoryBudget, vtkTypeInt64);
  ///@}

  enum DetailSelections
  {
    RENDERING_FRONT = 0,
    VIEW_SPECIFIC = 1
  };
  ///@{
  /**
   * How the detail of a view is chosen. RENDERING_FRONT (default): each part of the cloud as fine
   * as its projected point spacing asks for (Richter & Doellner 2010, section 3.2.1).
   * VIEW_SPECIFIC: an overview of the whole cloud is always there, and one detail level for the
   * view fills its pixels, near to far (Futterlieb, Teutsch & Berndt 2016, section 3.1).
   * TargetError and the budgets hold for both. Can be changed between any two frames.
   */
  vtkSetClampMacro(DetailSelection, int, RENDERING_FRONT, VIEW_SPECIFIC);
  vtkGetMacro(DetailSelection, int);
  void SetDetailSelectionToRenderingFront() { this->SetDetailSelection(RENDERING_FRONT); }
  void SetDetailSelectionToViewSpecific() { this->SetDetailSelection(VIEW_SPECIFIC); }
  ///@}

  ///@{
  /**
   * VIEW_SPECIFIC: points of the overview that all open stores of this process share, in
   * proportion to their sizes. Default 2,000,000.
   */
  vtkSetClampMacro(OverviewPoints, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(OverviewPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * Diameter of a point in pixels; 0 (default): the property's point size.
   */
  vtkSetClampMacro(PointSize, double, 0.0, 255.0);
  vtkGetMacro(PointSize, double);
  ///@}

  enum Backends
  {
    AUTOMATIC = 0,
    OPENGL = 1,
    SOFTWARE = 2
  };
  ///@{
  /**
   * Who turns points into pixels. OPENGL: the window's GL. SOFTWARE: threads of this process, from
   * the points where they are in host memory; colour and depth enter the window's picture in the
   * opaque pass, where other actors, passes and selections see them as any other geometry's.
   * AUTOMATIC (default): SOFTWARE where the window's GL is itself a program (GL_RENDERER llvmpipe,
   * softpipe), else OPENGL. Both draw the same pictures but for rounding. What SOFTWARE does not
   * draw (translucent points, an actor's own shader code) OPENGL does, and the other way round
   * (holes that are filled); a warning says so once where another one was asked for.
   */
  vtkSetClampMacro(Backend, int, AUTOMATIC, SOFTWARE);
  vtkGetMacro(Backend, int);
  void SetBackendToAutomatic() { this->SetBackend(AUTOMATIC); }
  void SetBackendToOpenGL() { this->SetBackend(OPENGL); }
  void SetBackendToSoftware() { this->SetBackend(SOFTWARE); }
  ///@}

  ///@{
  /**
   * On: a still render (desired update rate below 0.01... as VTK and ParaView set it) loads and
   * draws everything that TargetError and the budgets allow before it returns: screenshots, batch.
   * The image is then deterministic. Default off.
   */
  vtkSetMacro(Complete, bool);
  vtkGetMacro(Complete, bool);
  vtkBooleanMacro(Complete, bool);
  ///@}

  ///@{
  /**
   * Milliseconds that a frame should take while the user interacts, with all clouds of the window
   * together. 0 (default): the time that VTK
   * allots (vtkProp::GetAllocatedRenderTime, from the window's DesiredUpdateRate).
   */
  vtkSetClampMacro(TargetFrameTime, double, 0.0, 10000.0);
  vtkGetMacro(TargetFrameTime, double);
  ///@}

  ///@{
  /**
   * Milliseconds in which detail that comes or goes grows from nothing to its size, or shrinks;
   * while the user interacts the last points of what is shown of a node stay smaller. So nothing
   * pops up. 0: what is new is there at once. Pictures of views at rest are the same either way.
   * Points of a fixed number of pixels do not grow: they appear one after the other. Default 250.
   */
  vtkSetClampMacro(GrowthTime, double, 0.0, 10000.0);
  vtkGetMacro(GrowthTime, double);
  ///@}

  ///@{
  /**
   * Bytes uploaded to the GPU per frame while interacting. Default 16 MiB.
   */
  vtkSetClampMacro(UploadLimit, vtkTypeInt64, 1 << 16, VTK_TYPE_INT64_MAX);
  vtkGetMacro(UploadLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * For distributed rendering: this mapper draws piece `StorePiece` of `NumberOfStorePieces` of the
   * store (whole subtrees; the pieces together draw each point once) and loads only that. Default 0
   * of 1.
   */
  vtkSetMacro(StorePiece, int);
  vtkGetMacro(StorePiece, int);
  vtkSetClampMacro(NumberOfStorePieces, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfStorePieces, int);
  ///@}

  ///@{
  /**
   * Object classes with a tree of their own (stores with layers; `pointfront info` lists them) may
   * have a threshold, a share of the budgets and a switch of their own (Richter, Discher & Doellner
   * 2015, section 4.2). `objectClass` is the class's number in the store (2 ground, 6 building...);
   * -1 stands for the single layer of a store without layers. A class that no store of this mapper
   * has is remembered and ignored.
   *
   * Visibility: a class that is switched off is not drawn and not loaded; its share goes to the
   * others. Default on.
   * TargetErrorFactor: its target is TargetError times this, [0.01, 100]. Default 1.
   * BudgetShare: of PointBudget and of the host memory, [0, 1]: so much it has before all others.
   * What it does not need is lent to others and taken back when it does. Default 0: no share of its
   * own; the largest errors win.
   */
  void SetClassVisibility(int objectClass, bool visible);
  bool GetClassVisibility(int objectClass) const;
  void SetClassTargetErrorFactor(int objectClass, double factor);
  double GetClassTargetErrorFactor(int objectClass) const;
  void SetClassBudgetShare(int objectClass, double share);
  double GetClassBudgetShare(int objectClass) const;
  void ClearClassLimits();
  ///@}

  /**
   * "draft", "balanced" or "exact": a place between speed and accuracy. Sets TargetError, and how
   * the style's points become pixels; without a style the mapper gets one. False, and an error, for
   * another name.
   */
  bool SetQuality(const std::string& name);

  ///@{
  /**
   * Draws by a style: its changes show in the next frame. PointSize and the properties of vtkMapper
   * that choose colours do not count then. Null (default): they do.
   */
  void SetStyle(vtkPointFrontStyle* style);
  vtkPointFrontStyle* GetStyle() const;
  ///@}
  vtkMTimeType GetMTime() override; ///< the style's too

#ifndef __VTK_WRAP__
  /**
   * Draws by a style sheet: techniques, colours, sizes, visibility and filters of each object
   * class, and shading. PointSize and the properties of vtkMapper that choose colours do not count
   * then. Null (default): they do. Where the store has not what the sheet asks for, an error says
   * so and they count as well.
   */
  void SetStyleSheet(std::shared_ptr<const pointfront::StyleSheet> sheet);
  /// The style's sheet where there is a style, else what was set.
  std::shared_ptr<const pointfront::StyleSheet> GetStyleSheet() const;
#endif

  /// The store being drawn: named by the input's field data. Null until the input is there or if it
  /// cannot be opened.
  vtkPointFrontStore* GetStore();

  /// Of the last frame. Error in pixels; Threshold is what the front worked with.
  ///@{
  vtkIdType GetLastPointsDrawn() const;
  /// Beside these: what the picture before showed and the front lacked while the view moved.
  vtkIdType GetLastPointsKept() const;
  vtkIdType GetLastNodesDrawn() const;
  vtkIdType GetLastFrontLength() const;
  vtkIdType GetLastMoves() const;
  vtkIdType GetLastRequests() const;
  double GetLastError() const;
  double GetLastThreshold() const;
  double GetLastFrontTime() const; ///< milliseconds of the front's update
  vtkTypeInt64 GetLastGPUBytes() const;
  /// As LastGPUBytes, of all clouds of the window together.
  vtkTypeInt64 GetLastWindowGPUBytes() const;
  /// True when the last frame showed all that TargetError and the budgets allow: no further render
  /// will change the picture.
  bool GetLastComplete() const;
  /// True when PointBudget, or the time of a frame in motion, kept the error above TargetError.
  bool GetLastLimitedByPoints() const;
  /// True when GPUMemoryBudget did.
  bool GetLastLimitedByGPUMemory() const;
  /// True when the store's host memory budget did.
  bool GetLastLimitedByMemory() const;
  /// Nodes of this view that could not be read; what lies above them is drawn in their place.
  vtkIdType GetLastFailedNodes() const;
  ///@}

  enum EventIds
  {
    /// Invoked after a frame that is the first to be complete (LastComplete) for its view: the
    /// picture is as good as the budgets allow and stays so until something is changed.
    ViewCompleteEvent = 10440
  };

  /**
   * True if nodes arrived since the last render, or the last render left work over: render again.
   * Cheap, non blocking; for timers and render loops, from the rendering thread. While a view at
   * rest is being loaded, drawings take a quarter of the time at most: until then this moves the
   * front alone, so that loading does not wait for a slow drawing, and says false. False for a
   * mapper that no renderer shows: hidden or out of sight, it leaves its part of the budgets to the
   * others.
   */
  virtual bool NeedsRender();

  /**
   * Renders the interactor's window from a timer of it whenever NeedsRender(): what an application
   * without an event loop of its own needs to see a view refine. Invokes
   * vtkCommand::UpdateDataEvent before each. Null ends it.
   */
  void RenderWhenDataArrives(vtkRenderWindowInteractor* interactor);

  /// Of the whole store, at once, before anything is loaded.
  double* GetBounds() VTK_SIZEHINT(6) override;
  void GetBounds(double bounds[6]) override
  {
    this->Superclass::GetBounds(bounds);
  }

  /// True when the lookup table has transparent colours.
  bool HasTranslucentPolygonalGeometry() override;

protected:
  vtkPointFrontMapper();
  ~vtkPointFrontMapper() override;

#ifndef __VTK_WRAP__
  /**
   * For the OpenGL side, at each RenderPiece: what that renderer draws. The front is moved on the
   * first call of a frame; all others (peeling, selection and shadow passes draw one frame several
   * times) get the same nodes. Valid until the next call or the end of the renderer's frame. Null,
   * and an error once a cause, without a store.
   */
  pointfront::FramePlan* PlanFrame(vtkRenderer* renderer, vtkActor* actor);
  /// True from PlanFrame() to FinishFrame(): the frame's first drawing, which uploads.
  bool IsFirstDrawing(vtkRenderer* renderer) const;
  /// True when the front was moved since the renderer's last frame (see NeedsRender()): what a
  /// further drawing of that frame shows may not be on the GPU yet.
  bool IsAheadOfFrame(vtkRenderer* renderer) const;
  /// What the first drawing of a frame came to; `keptPoints`: drawn beside the front's, as they
  /// were visible before; `uploadsLeft` when not all points of the front are on the GPU yet.
  void FinishFrame(vtkRenderer* renderer, vtkIdType points, vtkIdType keptPoints, bool uploadsLeft);
  /// What an earlier frame of that renderer drew and cost, CPU and GPU, as soon as that is known.
  void RecordFrame(vtkRenderer* renderer, vtkIdType points, vtkIdType moves, double milliseconds);
  /// A renderer drew a frame, and none shows this mapper any more: what it has on the GPU is idle.
  virtual void LeaveScreen();
  /// Points are drawn from host memory: no GPU memory is taken for them.
  virtual bool DrawsFromHostMemory(vtkActor*)
  {
    return false;
  }
  /// Points of some pixels, in one colour each, all of them, and nothing done to the picture.
  bool HasPlainPointsOnly(vtkActor* actor);
  /// How the store's layers are drawn, by their numbers.
  std::vector<pointfront::LayerStyling> GetStyling(vtkActor* actor);
  static bool IsInteracting(vtkRenderer* renderer);
  /// Of PointBudget, what this mapper may have on the GPU of a window beside the other clouds of
  /// it; 0: no limit.
  vtkIdType GetPointsOnGPU(vtkWindow* window) const;
  /// Renderers of a window that this mapper draws in.
  std::uint32_t GetNumberOfViews(vtkWindow* window) const;
  /// Of the last frame.
  pointfront::FrameStatistics& GetStatistics() const;
#endif

  double TargetError = 1.0;
  vtkIdType PointBudget = 5000000;
  vtkTypeInt64 GPUMemoryBudget = 0;
  int DetailSelection = RENDERING_FRONT;
  vtkIdType OverviewPoints = 2000000;
  double PointSize = 0.0;
  int Backend = AUTOMATIC;
  bool Complete = false;
  double TargetFrameTime = 0.0;
  double GrowthTime = 250.0;
  vtkTypeInt64 UploadLimit = 16 << 20;
  int StorePiece = 0;
  int NumberOfStorePieces = 1;

private:
  struct Content;
  pointfront::FrameDemand GetDemand(vtkRenderer* renderer, vtkActor* actor);
  pointfront::PlanRequest GetRequest(vtkRenderer* renderer, vtkActor* actor);
  bool MoveFront(vtkRenderer* renderer, vtkActor* actor);
  bool Announce();
  std::unique_ptr<Content> Internals;

  vtkPointFrontMapper(const vtkPointFrontMapper&) = delete;
  void operator=(const vtkPointFrontMapper&) = delete;
};

#endif
