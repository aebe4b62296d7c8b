/**
 * @class vtkPointFrontLASIndexer
 * @brief makes a LAS file drawable in place, by a small side file
 *
 * Index() reads the LAS file, which stays as it is, and writes a side file that tells which runs of
 * its points lie where. vtkPointFrontReader opens that side file as it opens a store. LAZ is
 * refused: its points have no places of their own.
 *
 * Invokes vtkCommand::ProgressEvent with the fraction done (double); an observer may then call
 * SetAbort(true), which leaves what was there before.
 *
 * Source: Kovac 2009, section 2. docs/formats/pfindex.md describes the file.
 */
#ifndef vtkPointFrontLASIndexer_h
#define vtkPointFrontLASIndexer_h

#include "pointfrontIOLASIndexModule.h" // for the export macro
#include "vtkObject.h"

class POINTFRONTIOLASINDEX_EXPORT vtkPointFrontLASIndexer : public vtkObject
{
public:
  static vtkPointFrontLASIndexer* New();
  vtkTypeMacro(vtkPointFrontLASIndexer, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The LAS file, 1.0 to 1.4, any point format, uncompressed.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);

  ///@{
  /// The side file. Not set or empty: FileName with ".pfindex" behind.
  vtkSetFilePathMacro(IndexFileName);
  vtkGetFilePathMacro(IndexFileName);
  ///@}

  ///@{
  /// Whether an index that is there may be replaced; any other file is refused. Default off.
  vtkSetMacro(Overwrite, bool);
  vtkGetMacro(Overwrite, bool);
  vtkBooleanMacro(Overwrite, bool);
  ///@}

  ///@{
  /// Most points of a leaf. Default 16384.
  vtkSetClampMacro(NodePoints, int, 256, 1 << 20);
  vtkGetMacro(NodePoints, int);
  ///@}

  ///@{
  /// Stops a running Index().
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  ///@}

  /// Writes the side file. False on failure (reported as vtkErrorMacro does) and when aborted.
  bool Index();

  /// Points of the file that Index() read last.
  vtkGetMacro(NumberOfPoints, vtkIdType);

protected:
  vtkPointFrontLASIndexer() = default;
  ~vtkPointFrontLASIndexer() override;

private:
  vtkPointFrontLASIndexer(const vtkPointFrontLASIndexer&) = delete;
  void operator=(const vtkPointFrontLASIndexer&) = delete;

  char* FileName = nullptr;
  char* IndexFileName = nullptr;
  bool Overwrite = false;
  int NodePoints = 16384;
  bool Abort = false;
  vtkIdType NumberOfPoints = 0;
};

#endif
