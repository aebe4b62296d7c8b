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
#include <optional> // for the look of a frame
#include <string> // for names
// for the views
#include <vector> // for layers

class vtkPointFrontStore;
class vtkPointFrontStyle;
class vtkRenderWindowInteractor;
class vtkWindow;
namespace pointfront
{
class PictureExchange;
struct CloudLook;
struct FrameRequest;
struct FramePlan;
struct FrameStatistics;
struct LayerStyling;
struct PlanRequest;
struct StyleSheet;
struct ViewportMargin;
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
   * [0.01, 1000]; not a number: an error, and nothing changes.
   */
  virtual void SetTargetError(double pixels);
  virtual double GetTargetErrorMinValue() { return 0.01; }
  virtual double GetTargetErrorMaxValue() { return 1000.0; }
  vtkGetMacro(TargetError, double);
  ///@}

  ///@{
  /**
   * Most points drawn at a time (they are in GPU memory). All clouds of a window share this budget;
   * the largest errors on screen come first. Default 5,000,000; 0: no limit but memory.
   */
  vtkSetClampMacro(PointBudget, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(PointBudget, vtkIdType);
  ///@}

  ///@{
  /**
   * Most bytes of GPU memory for points, over all clouds of a window. A view that needs more
   * settles at the best error that fits (LastLimitedByGPUMemory). Buffers count, filled or not,
   * also in a frame in which they grow and in the first one after the budget was lowered. Default
   * 0: no limit but PointBudget.
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
   * VIEW_SPECIFIC: an overview of the whole cloud always stays in memory, and one detail level for
   * the view fills its pixels, near to far (Futterlieb, Teutsch & Berndt 2016, section 3.1).
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
   * Which back end turns points into pixels. OPENGL: the window's GL. SOFTWARE: threads of this
   * process, which read the points in host memory. Their colour and depth enter the window's
   * picture in the opaque pass, so other actors, passes and selections treat them as geometry.
   * AUTOMATIC (default): SOFTWARE where the window's GL is itself a program (GL_RENDERER llvmpipe,
   * softpipe), else OPENGL. Both draw the same pictures except for rounding. OPENGL draws what
   * SOFTWARE cannot (translucent points, a property's points as spheres, an actor's own shader
   * code), and SOFTWARE draws what OPENGL cannot (more than 4 lenses or 4 translucent styles). A
   * warning says so once if Backend asks for the other one. Multisampling smooths the edges of
   * points that OPENGL draws without a style; pictures of SOFTWARE have one sample a pixel.
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
   * together. 0 (default): the time that VTK allots (vtkProp::GetAllocatedRenderTime, from the
   * window's DesiredUpdateRate).
   */
  vtkSetClampMacro(TargetFrameTime, double, 0.0, 10000.0);
  vtkGetMacro(TargetFrameTime, double);
  ///@}

  ///@{
  /**
   * Milliseconds in which new detail grows from nothing to its size, and detail that goes shrinks,
   * so that nothing pops up. While the user interacts, the last shown points of a node stay
   * smaller. 0: new detail appears at full size. Pictures of views at rest are the same with any
   * value. Points of a fixed number of pixels do not grow: they appear one after the other. Default
   * 250.
   */
  vtkSetClampMacro(GrowthTime, double, 0.0, 10000.0);
  vtkGetMacro(GrowthTime, double);
  ///@}

  ///@{
  /**
   * Bytes uploaded to the GPU per frame; at rest with Complete there is no limit. Default 16 MiB.
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
   * Visibility: a class that is switched off is neither drawn nor loaded; its share goes to the
   * other classes. Default on. TargetErrorFactor: the target of the class is TargetError times this
   * factor, [0.01, 100]. Default 1. BudgetShare: the share of PointBudget and of the host memory,
   * [0, 1], that the class gets before all others. The mapper lends an unused part of the share to
   * other classes and takes it back when the class needs it. Default 0: no share of its own; the
   * largest errors win.
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
   * "draft", "balanced" or "exact"; an SSIM, as "0.95"; or milliseconds of a frame, as "33ms": a
   * place between speed and accuracy, for a number the one of docs/tradeoffs.md that has it. Sets
   * TargetError, and how the style's points become pixels; without a style the mapper gets one.
   * False, and an error, for anything else.
   */
  bool SetQuality(const std::string& name);

  ///@{
  /**
   * Draws by a style: its changes show in the next frame. With a style, PointSize and the
   * properties of vtkMapper that choose colours have no effect. Null (default): they have.
   */
  void SetStyle(vtkPointFrontStyle* style);
  vtkPointFrontStyle* GetStyle() const;
  ///@}
  vtkMTimeType GetMTime() override; ///< the style's too
  /// Takes the input and all settings of another mapper, and shares its style.
  void ShallowCopy(vtkAbstractMapper* mapper) override;

#ifndef __VTK_WRAP__
  /**
   * For pieces on several processes. Whether a picture of this style takes more than its nearest
   * points by depth: it adds up the colours of splats ("ewa", blended splats), looks at the pixels
   * around one (eye-dome lighting, filled holes, highlights), has a lens around a class, or
   * translucent classes before others. In motion only what shows other things without it:
   * highlights, lenses around a class and translucent classes. The same on each process, whatever
   * it draws. And who exchanges these during the frames that follow; null (default): each process
   * has its own. All processes draw these frames, in software, with viewports of one size.
   */
  bool NeedsPictureExchange(vtkActor* actor, bool inMotion);
  void SetPictureExchange(pointfront::PictureExchange* exchange);
#endif

#ifndef __VTK_WRAP__
  /**
   * Draws by a style sheet: techniques, colours, sizes, visibility and filters of each object
   * class, and shading. With a sheet, PointSize and the properties of vtkMapper that choose colours
   * have no effect. Null (default): they have. If the store lacks something that the sheet asks
   * for, an error says so and these properties apply.
   */
  void SetStyleSheet(std::shared_ptr<const pointfront::StyleSheet> sheet);
  /// The sheet of the style if a style was set, else the sheet that was set.
  std::shared_ptr<const pointfront::StyleSheet> GetStyleSheet() const;
#endif

  /// The store being drawn: named by the input's field data. Null until the input is there or if it
  /// cannot be opened.
  vtkPointFrontStore* GetStore();

  /// Facts about the last frame. Threshold is the spacing in pixels that the front worked with.
  ///@{
  vtkIdType GetLastPointsDrawn() const;
  /// Points drawn of a class (as in SetClassVisibility()), 0 if the store has no tree of it.
  vtkIdType GetLastClassPointsDrawn(int objectClass);
#ifndef __VTK_WRAP__
  /// By the store's layers, as far as any has points; and those in sight that budgets leave out.
  const std::vector<std::uint64_t>& GetLastLayerPoints() const;
  const std::vector<std::uint16_t>& GetLastLayersLeftOut() const;
  void IgnoreLeftOut(); ///< no warning tells of LastLeftOut: the program that draws does
#endif
  /// Points drawn beside these while the view moved: seen before, which the frame's front lacks.
  vtkIdType GetLastPointsKept() const;
  vtkIdType GetLastNodesDrawn() const;
  vtkIdType GetLastFrontLength() const;
  vtkIdType GetLastMoves() const;
  vtkIdType GetLastRequests() const;
  double GetLastError() const;
  double GetLastThreshold() const;
  double GetLastFrontTime() const; ///< milliseconds of the front's update
  vtkTypeInt64 GetLastGPUBytes() const;
  /// As LastGPUBytes, over all clouds of the window.
  vtkTypeInt64 GetLastWindowGPUBytes() const;
  /// True when the last frame showed all that TargetError and the budgets allow (LastLeftOut: not
  /// everything): no further render will change the picture.
  bool GetLastComplete() const;
  /// True when PointBudget, or the time of a frame in motion, kept the error above TargetError.
  bool GetLastLimitedByPoints() const;
  /// True when GPUMemoryBudget kept the error above TargetError.
  bool GetLastLimitedByGPUMemory() const;
  /// True when the store's host memory budget kept the error above TargetError.
  bool GetLastLimitedByMemory() const;
  /// In sight without room for a single point: "class 2, class 6" or the store. A warning says it.
  std::string GetLastLeftOut();
  /// Nodes of this view that could not be read; the nodes above them are drawn in their place.
  vtkIdType GetLastFailedNodes() const;
  /// True when a renderer's last frame drew this mapper, and the facts above are of that frame.
  /// False for one that is hidden, out of sight or never was in view: there is nothing to wait for.
  bool IsSeen() const;
  ///@}

  ///@{
  /**
   * How far the last picture is expected to be from the truth: PSNR in dB, SSIM, and the share of
   * pixels that are off by more than 8 of 255, 0 to 1. Each is least, median and most of the scenes
   * that docs/tradeoffs.md measured by the same technique at LastError. False, and nothing is set,
   * where the technique or such an error was not measured. Source says what the numbers are of.
   */
  bool GetLastExpectedDifference(double psnr[3], double ssim[3], double shareOver8[3]) const;
  std::string GetLastExpectedSource() const;
  /// The technique in the words of that page: "points", "discs", "ellipses", "blended", "ewa",
  /// "ewa full"; empty where it was not measured.
  std::string GetLastTechnique() const;
  ///@}

  enum EventIds
  {
    /// Invoked after a frame that is the first to be complete (LastComplete) for its view: the
    /// picture is as good as the budgets allow and stays the same until something changes.
    ViewCompleteEvent = 10440
  };

  /**
   * True if nodes arrived since the last render, or the last render left work over: render again.
   * Cheap, non blocking; for timers and render loops, from the rendering thread. While a view at
   * rest is being loaded, drawings take a quarter of the time at most. Between two drawings this
   * function only moves the front, so that loading does not wait for a slow drawing, and returns
   * false. It returns false for a mapper that no renderer shows; a hidden mapper leaves its part of
   * the budgets to the others.
   */
  virtual bool NeedsRender();

  /**
   * Renders the interactor's window from one of its timers whenever NeedsRender() is true. An
   * application without an event loop of its own needs this to see a view refine. Invokes
   * vtkCommand::UpdateDataEvent before each render. Null stops the timer.
   */
  void RenderWhenDataArrives(vtkRenderWindowInteractor* interactor);

  /// Bounds of the whole store, known before any point is loaded.
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
   * Begins a drawing: the OpenGL side calls it in each RenderPiece. It goes over to the next
   * version of a store that is being built, and says how the cloud looks. None, and an error once a
   * cause, without a store.
   */
  std::optional<pointfront::CloudLook> BeginFrame(vtkRenderer* renderer, vtkActor* actor);
  /**
   * Plans what the renderer draws, after BeginFrame(). The first call of a frame moves the front;
   * all other calls (peeling, selection and shadow passes draw one frame several times) get the
   * same nodes. The plan is valid until the next call or the end of the renderer's frame.
   */
  pointfront::FramePlan& PlanFrame(
    vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look);
  /// True from PlanFrame() to FinishFrame(): the frame's first drawing, which uploads.
  bool IsFirstDrawing(vtkRenderer* renderer, vtkActor* actor) const;
  /// True when the front was moved since the renderer's last frame (see NeedsRender()): a further
  /// drawing of that frame may show nodes that are not on the GPU yet.
  bool IsAheadOfFrame(vtkRenderer* renderer, vtkActor* actor) const;
  /// The result of the first drawing of a frame. `keptPoints`: points drawn in addition to the
  /// front's, because they were visible before. `uploadsLeft`: not all points of the front are on
  /// the GPU yet.
  void FinishFrame(vtkRenderer* renderer, vtkActor* actor, vtkIdType points, vtkIdType keptPoints,
    bool uploadsLeft);
  /// Records the work of an earlier frame of that renderer, and its time on CPU and GPU; called as
  /// soon as the time is known.
  void RecordFrame(
    vtkRenderer* renderer, vtkActor* actor, vtkIdType points, vtkIdType moves, double milliseconds);
  /// Called after a frame where no renderer shows this mapper any more: its GPU memory is idle.
  virtual void LeaveScreen();
  /// Chooses the back end of a drawing: whether points are drawn from host memory, and take no GPU
  /// memory. BeginFrame() asks once.
  virtual bool DrawsFromHostMemory(vtkRenderer*, vtkActor*, const pointfront::CloudLook&)
  {
    return false;
  }
  static bool IsInteracting(vtkRenderer* renderer);
  /// The part of PointBudget that this mapper may have on the GPU of a window, beside the other
  /// clouds of the window; 0: no limit.
  vtkIdType GetPointsOnGPU(vtkWindow* window) const;
  /// Number of views in a window that show this mapper: renderers with an actor each.
  std::uint32_t GetNumberOfViews(vtkWindow* window) const;
  /// Statistics of the last frame.
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
  pointfront::PictureExchange* Exchange = nullptr;

private:
  struct Content;
  std::vector<pointfront::LayerStyling> GetStyling(vtkActor* actor);
  pointfront::CloudLook GetLook(vtkRenderer* renderer, vtkActor* actor);
  pointfront::FrameRequest GetFrameRequest(
    vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look);
  pointfront::PlanRequest GetRequest(
    vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look);
  bool MoveFront(vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look);
  bool Announce();
  std::unique_ptr<Content> Internals;

  vtkPointFrontMapper(const vtkPointFrontMapper&) = delete;
  void operator=(const vtkPointFrontMapper&) = delete;
};

#endif
