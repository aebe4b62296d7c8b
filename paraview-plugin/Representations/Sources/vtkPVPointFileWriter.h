/**
 * @class vtkPVPointFileWriter
 * @brief writes the points of any vtkPointSet as LAS or LAZ
 *
 * The name's ending says which. Points keep their point data: what is no field of LAS becomes extra
 * bytes. Points that a store gave keep its coordinates to the last step and its reference system;
 * others have the steps of Precision, or those that `pointfront build` would choose. A file of the
 * same name is replaced, if it is one of LAS; never one of another kind.
 *
 * ProgressEvent; AbortExecuteOn() leaves no file. Errors: ErrorCode and vtkErrorMacro say what is
 * wrong, and there is no file, or the one that was there.
 */
#ifndef vtkPVPointFileWriter_h
#define vtkPVPointFileWriter_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkWriter.h"

#include <string>

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPVPointFileWriter : public vtkWriter
{
public:
  static vtkPVPointFileWriter* New();
  vtkTypeMacro(vtkPVPointFileWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file: *.las or *.laz.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// The step of written coordinates; 0 (default): see above.
  vtkSetMacro(Precision, double);
  vtkGetMacro(Precision, double);
  ///@}

protected:
  vtkPVPointFileWriter();
  ~vtkPVPointFileWriter() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkPVPointFileWriter(const vtkPVPointFileWriter&) = delete;
  void operator=(const vtkPVPointFileWriter&) = delete;

  /// An error, or a cancellation, which is none.
  void Fail(const std::string& why, bool cancelled = false);

  char* FileName = nullptr;
  double Precision = 0.0;
};

#endif
