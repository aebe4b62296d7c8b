/**
 * @class vtkPointFrontExtract
 * @brief the exact points of a region, of classes, of ranges of attributes, as vtkPolyData
 *
 * Reads from a store (or an index of a LAS file) the points that meet every condition that is set.
 * It skips nodes whose bounds or stored value ranges rule out every point. Without a condition it
 * reads the whole store: set MaximumNumberOfPoints or Spacing if that may not fit into memory.
 *
 * The store is named by FileName, or by the field data of an input (vtkPointFrontReader's output);
 * FileName goes first. Nothing else of the input is used.
 *
 * Output: double points in the store's order, one vertex cell each, the chosen attributes as point
 * data (as vtkPointFrontReader gives them: "rgb" is the active scalars, three bytes; attributes
 * with a scale or an offset are doubles with both applied), and numbers in the store as global ids,
 * the 64-bit array "point_id": the ids of hardware selections.
 *
 * Pieces: each piece reads its own nodes, with about as many points as any other; together they are
 * the whole. Events: ProgressEvent some ten times a second; an aborted update leaves an empty
 * output. Errors (ErrorCode, vtkErrorMacro): no store, a damaged store, a condition that cannot be
 * parsed or names an attribute that the store lacks, more points than MaximumNumberOfPoints.
 */
#ifndef vtkPointFrontExtract_h
#define vtkPointFrontExtract_h

#include "pointfrontFiltersExtractModule.h" // for the export macro
#include "vtkNew.h" // for the selection
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for planes and ids

#include <memory> // for the internals

class vtkDataArraySelection;
class vtkIdTypeArray;
class vtkPlanes;
class vtkPointFrontStore;

class POINTFRONTFILTERSEXTRACT_EXPORT vtkPointFrontExtract : public vtkPolyDataAlgorithm
{
public:
  static vtkPointFrontExtract* New();
  vtkTypeMacro(vtkPointFrontExtract, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The store's file. Null: the input's field data names it.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Points inside or on a box: xmin, xmax, ymin, ymax, zmin, zmax; ends may be infinite. A lower
   * end above the upper one is an error. Off by default.
   */
  vtkSetMacro(UseBox, bool);
  vtkGetMacro(UseBox, bool);
  vtkBooleanMacro(UseBox, bool);
  vtkSetVector6Macro(Box, double);
  vtkGetVector6Macro(Box, double);
  ///@}

  ///@{
  /**
   * Points inside or on a sphere. Off by default.
   */
  vtkSetMacro(UseSphere, bool);
  vtkGetMacro(UseSphere, bool);
  vtkBooleanMacro(UseSphere, bool);
  vtkSetVector3Macro(SphereCenter, double);
  vtkGetVector3Macro(SphereCenter, double);
  vtkSetMacro(SphereRadius, double);
  vtkGetMacro(SphereRadius, double);
  ///@}

  ///@{
  /**
   * Points on the inner side of all planes, whose normals point outwards: a frustum of
   * vtkPlanes::SetFrustumPlanes or of vtkAreaPicker. Null: none.
   */
  virtual void SetFrustum(vtkPlanes* planes);
  vtkPlanes* GetFrustum();
  ///@}

  ///@{
  /**
   * Points above or below areas, or within LineDistance of lines, on the map: POLYGON,
   * MULTIPOLYGON, LINESTRING ... as well-known text, in the store's coordinates. Holes are out,
   * edges are in. Null: none.
   */
  vtkSetStringMacro(WellKnownText);
  vtkGetStringMacro(WellKnownText);
  vtkSetMacro(LineDistance, double);
  vtkGetMacro(LineDistance, double);
  ///@}

  ///@{
  /**
   * Object classes (0 to 255) whose points are wanted. None added: of any class. With any other
   * number the update is an error.
   */
  void AddObjectClass(int objectClass);
  void ClearObjectClasses();
  int GetNumberOfObjectClasses();
  int GetObjectClass(int index);
  ///@}

  ///@{
  /**
   * Conditions on attributes and coordinates, as the tool's option `--where` takes them: "intensity
   * in [100, 200] and classification in {2, 6}". Null: none.
   */
  vtkSetStringMacro(Where);
  vtkGetStringMacro(Where);
  ///@}

  ///@{
  /**
   * World units between neighbouring points: gives a coarser subset, of the first whole levels of
   * the tree whose spacing is at most this. Each level halves the spacing, so the subset is as
   * dense as this or up to twice as dense along a line. 0, the default: all points.
   */
  vtkSetClampMacro(Spacing, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Spacing, double);
  ///@}

  ///@{
  /**
   * Numbers of picked or selected points in the store, in any order. The output has these points,
   * and all conditions above are ignored. Null: none.
   */
  virtual void SetPointIds(vtkIdTypeArray* ids);
  vtkIdTypeArray* GetPointIds();
  ///@}

  ///@{
  /**
   * Which attributes come with the points. By default all that the cloud holds, without those that
   * are computed while it loads (normals of LAS files in place, COPC and EPT). Names are known
   * after UpdateInformation() where FileName is set; others can be disabled by name before.
   */
  vtkDataArraySelection* GetPointDataArraySelection();
  int GetNumberOfPointArrays();
  const char* GetPointArrayName(int index);
  int GetPointArrayStatus(const char* name);
  void SetPointArrayStatus(const char* name, int status);
  ///@}

  ///@{
  /**
   * More points than this are an error, so that a large result cannot exhaust the memory. Default:
   * no limit.
   */
  vtkSetClampMacro(MaximumNumberOfPoints, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * Most memory in bytes for nodes that are being read, in addition to the output. Default 256 MiB.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * On: the points are counted and none come out, whatever MaximumNumberOfPoints says. It reads
   * what the extraction would read, except attributes that no condition names. Default off.
   */
  vtkSetMacro(CountOnly, bool);
  vtkGetMacro(CountOnly, bool);
  vtkBooleanMacro(CountOnly, bool);
  ///@}

  ///@{
  /**
   * On: each point has a vertex cell, as filters and views of cells want it: 16 bytes a point, by
   * numbers of 64 bits. Default on.
   */
  vtkSetMacro(VertexCells, bool);
  vtkGetMacro(VertexCells, bool);
  vtkBooleanMacro(VertexCells, bool);
  ///@}

  ///@{
  /**
   * On: "rgb" has the type and the values that the store has, 16 bits where it has 16, and is an
   * array like others. Off, the default: it is the active scalars, three bytes, which VTK takes as
   * colours.
   */
  vtkSetMacro(ColorsAsStored, bool);
  vtkGetMacro(ColorsAsStored, bool);
  vtkBooleanMacro(ColorsAsStored, bool);
  ///@}

  /// Points of the last update and its piece that meet all conditions.
  vtkGetMacro(NumberOfPointsChosen, vtkIdType);

  ///@{
  /**
   * Nodes and bytes that the last update read from the disk, and points that it decoded.
   */
  vtkGetMacro(NumberOfNodesRead, vtkIdType);
  vtkGetMacro(NumberOfPointsRead, vtkIdType);
  vtkGetMacro(NumberOfBytesRead, vtkTypeInt64);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkPointFrontExtract();
  ~vtkPointFrontExtract() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* FileName = nullptr;
  bool UseBox = false;
  double Box[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  bool UseSphere = false;
  double SphereCenter[3] = { 0.0, 0.0, 0.0 };
  double SphereRadius = 1.0;
  vtkSmartPointer<vtkPlanes> Frustum;
  char* WellKnownText = nullptr;
  double LineDistance = 0.0;
  char* Where = nullptr;
  double Spacing = 0.0;
  vtkSmartPointer<vtkIdTypeArray> PointIds;
  vtkIdType MaximumNumberOfPoints;
  vtkTypeInt64 MemoryLimit = 268435456;
  bool CountOnly = false;
  bool VertexCells = true;
  bool ColorsAsStored = false;
  vtkIdType NumberOfPointsChosen = 0;
  vtkIdType NumberOfNodesRead = 0;
  vtkIdType NumberOfPointsRead = 0;
  vtkTypeInt64 NumberOfBytesRead = 0;
  vtkNew<vtkDataArraySelection> PointDataArraySelection;

private:
  vtkPointFrontExtract(const vtkPointFrontExtract&) = delete;
  void operator=(const vtkPointFrontExtract&) = delete;

  bool OpenStore(const char* fileName);

  struct Content;
  std::unique_ptr<Content> Internals;
};

#endif
