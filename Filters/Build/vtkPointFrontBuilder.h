/**
 * @class vtkPointFrontBuilder
 * @brief builds a `.pfront` store from point files
 *
 * Write() reads the files of FileNames (every family that this build of PointFront carries; the
 * content decides, not the name) and writes the store OutputFileName: whole, or not at all. The
 * store's bytes do not depend on memory, threads or the order of the file names.
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

class POINTFRONTFILTERSBUILD_EXPORT vtkPointFrontBuilder : public vtkAlgorithm
{
public:
  static vtkPointFrontBuilder* New();
  vtkTypeMacro(vtkPointFrontBuilder, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The files to read.
  void AddFileName(VTK_FILEPATH const char* fileName);
  void ClearFileNames();
  int GetNumberOfFileNames();
  VTK_FILEPATH const char* GetFileName(int index);
  ///@}

  ///@{
  /// The store to write.
  vtkSetFilePathMacro(OutputFileName);
  vtkGetFilePathMacro(OutputFileName);
  ///@}

  ///@{
  /// Replace an existing store. Off by default: one that is there is an error.
  vtkSetMacro(Overwrite, bool);
  vtkGetMacro(Overwrite, bool);
  vtkBooleanMacro(Overwrite, bool);
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
  /// Step of the stored coordinates, world units. 0: the files' own (lossless).
  vtkSetClampMacro(Precision, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Precision, double);
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
   * How the build gets on, for observers of ProgressEvent. SecondsRemaining is -1 until there is an
   * estimate.
   */
  vtkGetMacro(PointsDone, vtkIdType);
  vtkGetMacro(PointsTotal, vtkIdType);
  vtkGetMacro(PointsPerSecond, double);
  vtkGetMacro(SecondsRemaining, double);
  ///@}

  ///@{
  /// Of the last Write() that succeeded.
  vtkGetMacro(NumberOfPointsRead, vtkIdType);
  vtkGetMacro(NumberOfPointsStored, vtkIdType);
  vtkGetMacro(NumberOfNodes, vtkIdType);
  vtkGetMacro(BytesWritten, vtkTypeInt64);
  vtkGetMacro(BytesSpilled, vtkTypeInt64);
  ///@}

protected:
  vtkPointFrontBuilder();
  ~vtkPointFrontBuilder() override;

  char* OutputFileName = nullptr;
  char* TemporaryFolder = nullptr;
  bool Overwrite = false;
  bool Preview = true;
  vtkIdType PreviewPoints = 4000000;
  vtkTypeInt64 MemoryLimit = 0;
  int NumberOfThreads = 0;
  int NodePoints = 16384;
  double Precision = 0.0;
  vtkIdType PointsDone = 0;
  vtkIdType PointsTotal = 0;
  double PointsPerSecond = 0.0;
  double SecondsRemaining = -1.0;
  vtkIdType NumberOfPointsRead = 0;
  vtkIdType NumberOfPointsStored = 0;
  vtkIdType NumberOfNodes = 0;
  vtkTypeInt64 BytesWritten = 0;
  vtkTypeInt64 BytesSpilled = 0;

private:
  vtkPointFrontBuilder(const vtkPointFrontBuilder&) = delete;
  void operator=(const vtkPointFrontBuilder&) = delete;

  struct Content;
  std::unique_ptr<Content> Internals;
};

#endif
