/**
 * @class vtkPointFrontBuilder
 * @brief builds a `.pfront` store from point files
 *
 * Write() reads the files of FileNames (every family that this build of PointFront carries; the
 * content decides, not the name) and writes the store OutputFileName: whole, or not at all. The
 * store's bytes do not depend on memory, threads or the order of the file names. Every property
 * means what the option of `pointfront build` of that name means (docs/user/command-line.md).
 *
 * Events, all on the thread that calls Write(), some ten times a second: ProgressEvent (call data:
 * fraction, a double; GetProgressText() is the phase, GetPointsDone(), GetPointsPerSecond(),
 * GetSecondsRemaining() tell more), UpdateDataEvent when a new version of the preview can be opened
 * (GetPreviewFileName(); vtkPointFrontMapper follows it by itself), StartEvent, EndEvent,
 * AbortCheckEvent. AbortExecuteOn() from an observer ends the build and leaves nothing.
 *
 * Errors: Write() returns 0, ErrorCode says of which kind, vtkErrorMacro what, where and what to
 * try; an abort is ErrorCode UserError without a message.
 */
#ifndef vtkPointFrontBuilder_h
#define vtkPointFrontBuilder_h

#include "pointfrontFiltersBuildModule.h" // for the export macro
#include "vtkAlgorithm.h"

#include <memory> // for the kernel's side

class vtkPointSet;

class POINTFRONTFILTERSBUILD_EXPORT vtkPointFrontBuilder : public vtkAlgorithm
{
public:
  static vtkPointFrontBuilder* New();
  vtkTypeMacro(vtkPointFrontBuilder, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The files to read; a folder stands for the point files below it, a pattern (*, ?) for what it
  /// matches. Their order does not matter.
  void AddFileName(VTK_FILEPATH const char* fileName);
  void ClearFileNames();
  int GetNumberOfFileNames();
  VTK_FILEPATH const char* GetFileName(int index);
  ///@}

  /// @{ A data set whose points and point data are stored instead of files. Null: none.
  void SetPoints(vtkPointSet* points);
  vtkPointSet* GetPoints();
  ///@}

  ///@{
  /// The store to write.
  vtkSetFilePathMacro(OutputFileName);
  vtkGetFilePathMacro(OutputFileName);
  ///@}

  /// @{ Replace an existing store. Off by default: an existing store is an error. Write() never
  /// replaces a file of another kind, nor a file that it reads.
  vtkSetMacro(Overwrite, bool);
  vtkGetMacro(Overwrite, bool);
  vtkBooleanMacro(Overwrite, bool);
  ///@}

  /// @{ Leave out files that are no point files, are damaged or hold no position; each is a
  /// warning, and counted. Write() then reads all files twice. Off by default: such files are an
  /// error that names all of them.
  vtkSetMacro(SkipFaultyFiles, bool);
  vtkGetMacro(SkipFaultyFiles, bool);
  vtkBooleanMacro(SkipFaultyFiles, bool);
  ///@}

  ///@{
  /// Most memory for points, bytes; beyond it they are spilled to disk. 0: half of the machine's.
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /// Folder for spill files. Null: the store's.
  vtkSetFilePathMacro(TemporaryFolder);
  vtkGetFilePathMacro(TemporaryFolder);
  ///@}

  ///@{
  /// Threads. 0: one a core.
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /// Most points of a leaf. Default 16384.
  vtkSetClampMacro(NodePoints, int, 256, 1 << 20);
  vtkGetMacro(NodePoints, int);
  ///@}

  ///@{
  /// Step of the stored coordinates, world units. 0: the inputs' own (lossless); where floating
  /// point numbers lie on no decimal step, one by their extent, with a warning.
  vtkSetClampMacro(Precision, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Precision, double);
  ///@}

  ///@{
  /**
   * Only points inside or on a box, in the coordinates of the files: xmin, xmax, ymin, ymax, zmin,
   * zmax; ends may be infinite. Of files that have an index (stores, COPC, EPT, collections, and
   * all addresses) no more is read than the box needs. Off by default. Write() fails if a lower end
   * lies above the upper one, and if no point lies in the box.
   */
  vtkSetMacro(UseBox, bool);
  vtkGetMacro(UseBox, bool);
  vtkBooleanMacro(UseBox, bool);
  vtkSetVector6Macro(Box, double);
  vtkGetVector6Macro(Box, double);
  ///@}

  ///@{
  /// Shape of the hierarchy. A kd-tree has RefinementType ADD only. Default OCTREE.
  enum StructureType
  {
    OCTREE = 0,
    KDTREE = 1
  };
  vtkSetClampMacro(Structure, int, OCTREE, KDTREE);
  vtkGetMacro(Structure, int);
  void SetStructureToOctree() { this->SetStructure(OCTREE); }
  void SetStructureToKdTree() { this->SetStructure(KDTREE); }
  ///@}

  ///@{
  /// Inner nodes hold a subset of the points (ADD), or mean points that their children replace.
  enum RefinementType
  {
    ADD = 0,
    REPLACE = 1
  };
  vtkSetClampMacro(Refinement, int, ADD, REPLACE);
  vtkGetMacro(Refinement, int);
  void SetRefinementToAdd() { this->SetRefinement(ADD); }
  void SetRefinementToReplace() { this->SetRefinement(REPLACE); }
  ///@}

  ///@{
  /// One tree for all points, or one for each class; AUTOMATIC (default): by class if any point is
  /// classified.
  enum LayersType
  {
    AUTOMATIC = 0,
    NO_LAYERS = 1,
    BY_CLASS = 2
  };
  vtkSetClampMacro(Layers, int, AUTOMATIC, BY_CLASS);
  vtkGetMacro(Layers, int);
  void SetLayersToAutomatic() { this->SetLayers(AUTOMATIC); }
  void SetLayersToNone() { this->SetLayers(NO_LAYERS); }
  void SetLayersToClass() { this->SetLayers(BY_CLASS); }
  ///@}

  ///@{
  /// Attributes to store. None named: all.
  void AddAttribute(const char* name);
  void ClearAttributes();
  ///@}

  ///@{
  /// Bits of 16-bit colours: 8, 16, or 0 (default), by the largest in each file.
  vtkSetMacro(ColorDepth, int);
  vtkGetMacro(ColorDepth, int);
  ///@}

  ///@{
  /**
   * Coordinate reference system of the store ("EPSG:25832", a WKT file, "utm"; null: the files'
   * own), and the system of files that name none (null: unknown).
   */
  vtkSetStringMacro(CRS);
  vtkGetStringMacro(CRS);
  vtkSetStringMacro(AssumedCRS);
  vtkGetStringMacro(AssumedCRS);
  ///@}

  ///@{
  /// Estimate normals: from neighbours in the scan, or by PCA of the nearest points. Default none.
  enum NormalsType
  {
    NO_NORMALS = 0,
    SCAN_LINE = 1,
    PCA = 2
  };
  vtkSetClampMacro(Normals, int, NO_NORMALS, PCA);
  vtkGetMacro(Normals, int);
  void SetNormalsToNone() { this->SetNormals(NO_NORMALS); }
  void SetNormalsToScanLine() { this->SetNormals(SCAN_LINE); }
  void SetNormalsToPCA() { this->SetNormals(PCA); }
  ///@}

  ///@{
  /**
   * Options of PCA: the number of points of a plane, with the point itself (16), or all points
   * within NormalsRadius if that is not 0; NormalsError of an approximate search (0: exact);
   * whether to keep Curvature as an attribute. Write() fails if they are set without PCA or out of
   * range. Normals point to the scanner where files say where it stood, else up.
   */
  vtkSetMacro(NormalsNeighbors, int);
  vtkGetMacro(NormalsNeighbors, int);
  vtkSetMacro(NormalsRadius, double);
  vtkGetMacro(NormalsRadius, double);
  vtkSetMacro(NormalsError, double);
  vtkGetMacro(NormalsError, double);
  vtkSetMacro(Curvature, bool);
  vtkGetMacro(Curvature, bool);
  vtkBooleanMacro(Curvature, bool);
  ///@}

  ///@{
  /// Classes (0 to 255) that get normals. None named: all.
  void AddNormalsClass(int objectClass);
  void ClearNormalsClasses();
  ///@}

  ///@{
  /**
   * Attribute splat_radius: how large each point must be drawn for surfaces to close, measured
   * among its neighbours. Off by default; comes with normals by PCA.
   */
  vtkSetMacro(SplatRadius, bool);
  vtkGetMacro(SplatRadius, bool);
  vtkBooleanMacro(SplatRadius, bool);
  ///@}

  /// @{ Attribute local_height: height above the mean of the points of the same class within
  /// LocalHeightRadius (5).
  vtkSetMacro(LocalHeight, bool);
  vtkGetMacro(LocalHeight, bool);
  vtkBooleanMacro(LocalHeight, bool);
  vtkSetMacro(LocalHeightRadius, double);
  vtkGetMacro(LocalHeightRadius, double);
  ///@}

  /// @{ Attribute height_above_ground: the ground is class 2, or else the lowest points in cells of
  /// GroundCell (10).
  vtkSetMacro(HeightAboveGround, bool);
  vtkGetMacro(HeightAboveGround, bool);
  vtkBooleanMacro(HeightAboveGround, bool);
  vtkSetMacro(GroundCell, double);
  vtkGetMacro(GroundCell, double);
  ///@}

  ///@{
  /**
   * Colours, and values of attributes, from georeferenced images: files, patterns, folders. Where
   * images overlap, the first one counts.
   */
  void AddColorImage(VTK_FILEPATH const char* fileName);
  void AddAttributeImage(const char* attribute, VTK_FILEPATH const char* fileName);
  void ClearImages();
  ///@}

  ///@{
  /// Show a preview beside the store while it is built, if there are at least PreviewPoints points
  /// (4 million; fewer are built in the time that an overview takes). On by default.
  vtkSetMacro(Preview, bool);
  vtkGetMacro(Preview, bool);
  vtkBooleanMacro(Preview, bool);
  vtkSetClampMacro(PreviewPoints, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(PreviewPoints, vtkIdType);
  ///@}
  /// Where the preview is while Write() runs.
  VTK_FILEPATH const char* GetPreviewFileName();

  /// Builds the store. 1, or 0 with ErrorCode.
  int Write();

  ///@{
  /**
   * The progress of the build, for observers of ProgressEvent. SecondsRemaining is -1 until there
   * is an estimate.
   */
  vtkGetMacro(PointsDone, vtkIdType);
  vtkGetMacro(PointsTotal, vtkIdType);
  vtkGetMacro(PointsPerSecond, double);
  vtkGetMacro(SecondsRemaining, double);
  ///@}

  /// @{ Results of the last Write() that succeeded.
  vtkGetMacro(NumberOfPointsRead, vtkIdType);
  vtkGetMacro(NumberOfPointsStored, vtkIdType);
  vtkGetMacro(NumberOfPointsRejected, vtkIdType); ///< a warning counts them by reason
  vtkGetMacro(NumberOfPointsOutside, vtkIdType); ///< read, and not in the Box
  vtkGetMacro(NumberOfFilesSkipped, int);
  vtkGetMacro(NumberOfNodes, vtkIdType);
  vtkGetMacro(BytesWritten, vtkTypeInt64);
  vtkGetMacro(BytesSpilled, vtkTypeInt64);
  ///@}

protected:
  vtkPointFrontBuilder();
  ~vtkPointFrontBuilder() override;

  char* OutputFileName = nullptr;
  char* TemporaryFolder = nullptr;
  char* CRS = nullptr;
  char* AssumedCRS = nullptr;
  int Structure = OCTREE;
  int Refinement = ADD;
  int Layers = AUTOMATIC;
  int ColorDepth = 0;
  int Normals = NO_NORMALS;
  int NormalsNeighbors = 16;
  double NormalsRadius = 0.0;
  double NormalsError = 0.0;
  bool Curvature = false;
  bool SplatRadius = false;
  bool LocalHeight = false;
  double LocalHeightRadius = 5.0;
  bool HeightAboveGround = false;
  double GroundCell = 10.0;
  bool Overwrite = false;
  bool SkipFaultyFiles = false;
  bool Preview = true;
  vtkIdType PreviewPoints = 4000000;
  vtkTypeInt64 MemoryLimit = 0;
  int NumberOfThreads = 0;
  int NodePoints = 16384;
  double Precision = 0.0;
  bool UseBox = false;
  double Box[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  vtkIdType PointsDone = 0;
  vtkIdType PointsTotal = 0;
  double PointsPerSecond = 0.0;
  double SecondsRemaining = -1.0;
  vtkIdType NumberOfPointsRead = 0;
  vtkIdType NumberOfPointsStored = 0;
  vtkIdType NumberOfPointsRejected = 0;
  vtkIdType NumberOfPointsOutside = 0;
  int NumberOfFilesSkipped = 0;
  vtkIdType NumberOfNodes = 0;
  vtkTypeInt64 BytesWritten = 0;
  vtkTypeInt64 BytesSpilled = 0;

private:
  vtkPointFrontBuilder(const vtkPointFrontBuilder&) = delete;
  void operator=(const vtkPointFrontBuilder&) = delete;

  struct Content;
  bool CheckProperties();
  std::unique_ptr<Content> Internals;
};

#endif
