/**
 * @class vtkPointFrontRepresentation
 * @brief draws a point store in ParaView's render view with vtkPointFrontMapper
 *
 * The data that travels is the reader's overview; its field data names the store
 * (vtkPointFrontStore), and every process that renders opens the store itself. Only the reader's
 * own output is drawn: a filter passes the name on, and its points may be others. The points stay
 * where the files are: with a server the view is asked for distributed rendering, whatever the size
 * of the overview, and each rank draws and loads only its piece of the store. The pieces together
 * draw each point once; IceT composites them by depth.
 *
 * Regime: ParaView sets the window's DesiredUpdateRate on every rank (5 for an interactive render,
 * 0.002 for a still one). An interactive render keeps to 1 / rate seconds. A still render draws
 * what is loaded, and the client asks for further frames until nothing is missing
 * (vtkSMPointFrontRepresentationProxy) - unless CompleteStillRenders says that it shall load
 * everything before it returns.
 *
 * Exists on every process, as representations do; has an input on the data server only. Main
 * thread.
 */
#ifndef vtkPointFrontRepresentation_h
#define vtkPointFrontRepresentation_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkNew.h" // for the members
#include "vtkPVDataRepresentation.h"
#include "vtkSmartPointer.h" // for the store

#include <array>
#include <memory>
#include <string>

class vtkPVRenderView;
class vtkPointFrontMapper;
class vtkPointFrontStore;
class vtkPolyData;
class vtkProperty;
class vtkScalarsToColors;

namespace pointfront
{
struct ClassSettings;
class CloudActor;
class CloudColors;
class FXAAPause;
class RankExchange;
class SelectionMarks;
class StyleChoice;
} // namespace pointfront

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontRepresentation
  : public vtkPVDataRepresentation
{
public:
  static vtkPointFrontRepresentation* New();
  vtkTypeMacro(vtkPointFrontRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;
  void SetVisibility(bool visible) override;

  /// Which still renders load and draw everything that TargetError and the budgets allow before
  /// they return.
  enum StillRenders
  {
    WHEN_UNATTENDED = 0, ///< screenshots, animations and all in batch: nobody sees a next frame
    ALWAYS = 1,
    NEVER = 2
  };
  ///@{
  /**
   * Default WHEN_UNATTENDED.
   */
  vtkSetClampMacro(CompleteStillRenders, int, WHEN_UNATTENDED, NEVER);
  vtkGetMacro(CompleteStillRenders, int);
  ///@}

  ///@{
  /**
   * As in vtkPointFrontMapper: pixels; points; milliseconds, where 0 (default) keeps to the view's
   * desired update rate.
   */
  vtkSetClampMacro(TargetError, double, 0.01, 1000.0);
  vtkGetMacro(TargetError, double);
  void SetPointBudget(vtkIdType points);
  void SetGPUMemoryBudget(int mebibytes); ///< 0: no limit
  void SetDetailSelection(int method);
  vtkSetClampMacro(TargetFrameTime, double, 0.0, 10000.0);
  vtkGetMacro(TargetFrameTime, double);
  ///@}

  ///@{
  /**
   * Object classes of the store, by name ("ground" ...; "all" in a store without layers): whether
   * they are shown, and what they ask for (vtkPointFrontMapper::SetClassTargetErrorFactor and
   * SetClassBudgetShare). A name that the store does not have is remembered and ignored. The list
   * is empty on a process that has no input.
   */
  int GetNumberOfClasses();
  const char* GetNameOfClass(int index);
  void SetClassVisibility(const char* name, int shown);
  void ClearClassTargetErrorFactors();
  void SetClassTargetErrorFactor(const char* name, double factor);
  void ClearClassBudgetShares();
  void SetClassBudgetShare(const char* name, double share);
  ///@}

  ///@{
  /**
   * Colouring. MapScalars on: every array goes through the lookup table; off: colours are drawn as
   * they are. DirectColors on (default): "rgb" is drawn as it is even if MapScalars is on, other
   * arrays go through the table. Where an array is chosen that is no colour, the points are grey by
   * height, and a warning says so.
   */
  void SetLookupTable(vtkScalarsToColors* table);
  vtkSetMacro(MapScalars, bool);
  vtkGetMacro(MapScalars, bool);
  vtkSetMacro(DirectColors, bool);
  vtkGetMacro(DirectColors, bool);
  /// False for what names points: "point_id".
  static bool IsColor(const std::string& array);
  ///@}

  ///@{
  /**
   * How points look, as style sheets have it (docs/user/styles.md): "points" (default), "splats",
   * "spheres", "silhouettes", "solid", "ewa", or "blended" (splats in two passes); the diameter in
   * pixels (PointSize) or the one that closes the surface times a factor (PointLook::Closing says
   * when); eye-dome lighting (0, the default: off); light on points
   * that have a normal; holes between points filled; a condition for the points that are drawn. Who
   * draws: see vtkPointFrontMapper::SetBackend.
   */
  void SetTechnique(const char* name);
  /// "draft", "balanced" or "exact", an SSIM or a time ("0.95", "33ms"): technique, size and target
  /// error as vtkPointFrontMapper::SetQuality has them, whatever is set of these. "custom"
  /// (default): what is set. Anything else is an error of the next frame.
  void SetQuality(const char* name);
  void SetClosingSize(int closing);
  void SetSizeFactor(double factor);
  void SetEyeDomeStrength(double strength);
  void SetLit(int light);
  void SetFillHoles(bool fill);
  void SetWhere(const char* condition);
  void SetBackend(int backend);
  ///@}

  ///@{
  /**
   * FXAA takes single points for noise: on (default), views that show this have none.
   */
  vtkSetMacro(CrispPoints, bool);
  vtkGetMacro(CrispPoints, bool);
  ///@}

  ///@{
  /**
   * A style sheet, a JSON file as the server sees it: it says how points look, and what is above
   * does not count. Null or empty: what is above.
   */
  void SetStyleFile(const char* fileName);
  ///@}

  ///@{
  /**
   * What differs for a class, given by its code: technique, "hidden" or "" (as the others); colour,
   * an attribute or "#rrggbb" or ""; diameter in pixels or "".
   */
  void ClearClassStyles();
  void AddClassStyle(
    const char* classCode, const char* technique, const char* color, const char* size);
  ///@}

  ///@{
  /**
   * Light and eye-dome lighting of a class, given by its code: "on", "off", the share of ambient
   * light or "" (as the others); a strength or "".
   */
  void ClearClassLights();
  void AddClassLight(const char* classCode, const char* light, const char* eyeDomeStrength);
  ///@}

  ///@{
  /**
   * A lens that shows what it covers in other styles: its shape (LensPlace::Shape); its centre as
   * parts of the picture's width and height, from the lower left corner; a circle's radius as a
   * part of the height; a rectangle's size as parts of width and height; a mask as an image file,
   * as the server sees it; the code of a class and a radius around its points, in units of the
   * coordinates. Inside, as for classes; without a code for all classes.
   */
  void SetLensShape(int shape);
  void SetLensCenter(double x, double y);
  void SetLensRadius(double radius);
  void SetLensSize(double width, double height);
  void SetLensMask(const char* fileName);
  void SetLensClass(int classCode);
  void SetLensClassRadius(double radius);
  void ClearLensStyles();
  void AddLensStyle(
    const char* classCode, const char* technique, const char* color, const char* size);
  ///@}

  /// Milliseconds in which detail grows and shrinks (vtkPointFrontMapper::SetGrowthTime).
  void SetGrowthTime(double milliseconds);

  ///@{
  /**
   * Of the property and the actor, as in vtkGeometryRepresentation. On several ranks a translucent
   * cloud is one surface: the nearest points over what is behind the cloud.
   */
  void SetPointSize(double pixels);
  void SetOpacity(double opacity);
  void SetAmbientColor(double r, double g, double b);
  void SetDiffuseColor(double r, double g, double b);
  void SetPickable(int pickable);
  /// Where the cloud is moved to: the property Position of ParaView 5.11, Translation of 5.13. Of
  /// the two the one that the host lacks stays 0; both add up.
  void SetPosition(double x, double y, double z);
  void SetTranslation(double x, double y, double z);
  void SetScale(double x, double y, double z);
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  void SetUserTransform(const double matrix[16]);
  ///@}

  ///@{
  /**
   * Of this process's last frame: points and nodes drawn; the largest projected point spacing,
   * pixels. Zero on a process that draws nothing.
   */
  vtkIdType GetPointsDrawn();
  vtkIdType GetNodesDrawn();
  double GetProjectedSpacing();
  ///@}
  /// As vtkPointFrontMapper::GetLastTechnique(); empty on a process that draws nothing.
  std::string GetTechniqueDrawn();

  /// Points of the store that is drawn, all of them; 0 on a process that draws nothing.
  vtkIdType GetStorePoints();

  /// Nodes of this process's last frame that could not be read, and are missing in the picture.
  vtkIdType GetMissingNodes();

  /// Why the last frame of this process has not reached the target error: bits.
  enum FrameLimits
  {
    POINT_BUDGET = 1,
    GPU_MEMORY = 2,
    HOST_MEMORY = 4,
    FRAME_TIME = 8, ///< time of a frame in motion
    LOADING = 16, ///< not all points are there yet
    UNREADABLE = 32 ///< nodes that cannot be read
  };
  int GetFrameLimits();

  /// Memory that this process has for the points of all clouds, MiB (vtkPointFrontSettings).
  int GetHostMemoryBudget();

  /// False while a further frame would show more, now or when nodes that are being loaded have
  /// come.
  bool GetFrameComplete();

  /// The state of the drawn preview's build: "sorting, 43 %". Empty if there is none,
  /// and on all processes but the first of the data server.
  std::string GetBuildState();

  /// True if a further frame would show more now. Cheap, never waits.
  bool GetFrameOutdated();

protected:
  vtkPointFrontRepresentation();
  ~vtkPointFrontRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkPointFrontRepresentation(const vtkPointFrontRepresentation&) = delete;
  void operator=(const vtkPointFrontRepresentation&) = delete;

  /// Hands the overview and the cloud's bounds to the view.
  void ProvideData(vtkInformation* inInfo);
  /// Sets the mapper up for the frame that `view` is about to render.
  void PrepareFrame(vtkInformation* inInfo, vtkPVRenderView* view);
  void PrepareColors();
  /// Hands the mapper a style, if one is needed.
  void PrepareStyle();
  /// When the renderer starts: its size and camera are known.
  void BeginFrame();
  /// IceT composites points beyond the cloud's box, too, during a frame. Between frames the view
  /// takes boxes of actors for its clipping range, so that they are those of the clouds again.
  void CoverView();
  void UncoverView();
  void PlaceLens();
  void TellLensOfRanks(bool oneSurface);
  /// Ranks add up the colours of blended splats, if all of them can.
  void AgreeOnExchange();
  /// Warns, on one rank of all, unless there is nothing to say.
  void Tell(const std::string& warning);
  bool WantsComplete(vtkPVRenderView* view) const;
  /// Whether this process draws points of a store.
  bool IsDrawing();
  /// Whether its last frame did: the cloud is in view.
  bool IsSeen();

  vtkNew<vtkPointFrontMapper> Mapper;
  vtkNew<vtkProperty> Property;
  const vtkSmartPointer<pointfront::CloudActor> Actor;
  vtkNew<vtkPolyData> Overview; ///< data server: the input
  vtkSmartPointer<vtkPointFrontStore> Store; ///< data server: for the bounds of the whole cloud

  int CompleteStillRenders = WHEN_UNATTENDED;
  std::array<double, 3> Position{};
  std::array<double, 3> Translation{};
  double TargetFrameTime = 0.0;
  double TargetError = 1.0;
  bool MapScalars = true;
  bool DirectColors = true;
  bool ToldOfRanks = false; ///< that each has its part of a lens
  bool CrispPoints = true;
  bool InMotion = false; ///< the last frame
  unsigned long StartObserver = 0;
  unsigned long UncoverObserver = 0;
  const std::unique_ptr<pointfront::ClassSettings> Classes;
  const std::unique_ptr<pointfront::CloudColors> Colors;
  const std::unique_ptr<pointfront::FXAAPause> WithoutFXAA;
  const std::unique_ptr<pointfront::SelectionMarks> Marks; ///< not drawn while the view selects
  const std::unique_ptr<pointfront::StyleChoice> Choice;
  const std::unique_ptr<pointfront::RankExchange> Exchange;
  double PointSize = 2.0;
  double Opacity = 1.0;
};

#endif
