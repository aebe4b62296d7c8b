/**
 * @class vtkPointFrontWriter
 * @brief writes the points of any vtkPointSet as a `.pfront` store
 *
 * A store gets the points with their point data; it leaves out cells, points without a place (NaN),
 * and those that vtkGhostType marks. The writer replaces a store of the same name, as VTK's writers
 * do, but never a file of another kind. Every property means what that option of `pointfront build`
 * means.
 *
 * ProgressEvent and AbortExecuteOn() as in vtkPointFrontBuilder. Errors: Write() returns 1 as
 * vtkWriter's does; ErrorCode and vtkErrorMacro say what is wrong.
 */
#ifndef vtkPointFrontWriter_h
#define vtkPointFrontWriter_h

#include "pointfrontFiltersBuildModule.h" // for the export macro
#include "vtkWriter.h"

class POINTFRONTFILTERSBUILD_EXPORT vtkPointFrontWriter : public vtkWriter
{
public:
  static vtkPointFrontWriter* New();
  vtkTypeMacro(vtkPointFrontWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The store to write.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// As in vtkPointFrontBuilder, with its numbers.
  vtkSetMacro(Structure, int);
  vtkGetMacro(Structure, int);
  vtkSetMacro(Layers, int);
  vtkGetMacro(Layers, int);
  vtkSetMacro(Normals, int);
  vtkGetMacro(Normals, int);
  vtkSetMacro(Precision, double);
  vtkGetMacro(Precision, double);
  ///@}

protected:
  vtkPointFrontWriter();
  ~vtkPointFrontWriter() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  char* FileName = nullptr;
  int Structure = 0;
  int Layers = 0;
  int Normals = 0;
  double Precision = 0.0;

private:
  vtkPointFrontWriter(const vtkPointFrontWriter&) = delete;
  void operator=(const vtkPointFrontWriter&) = delete;
};

#endif
