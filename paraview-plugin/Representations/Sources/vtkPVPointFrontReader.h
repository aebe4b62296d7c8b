/**
 * @class vtkPVPointFrontReader
 * @brief vtkPointFrontReader as ParaView's source: its output says in field data what the store is
 *
 * What the Information panel shows, and what is saved with the overview: "store_points",
 * "store_bounds" (x, y, z, low and high), "store_crs", "store_structure", "store_classes" and
 * "store_class_points" (of a store with a tree for each class), "output_is" (what the points of the
 * output are, and where the exact ones come from). The same on each rank. The arrays of the output
 * have the ranges of the store's (vtkDataArray::GetRange), so colour maps span the whole cloud.
 */
#ifndef vtkPVPointFrontReader_h
#define vtkPVPointFrontReader_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPointFrontReader.h"

#include <string> // for facts

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPVPointFrontReader : public vtkPointFrontReader
{
public:
  static vtkPVPointFrontReader* New();
  vtkTypeMacro(vtkPVPointFrontReader, vtkPointFrontReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Describes the store, in lines for a panel; empty without a store.
  const char* GetStoreFacts();

  /// The traffic of this process with servers so far, all its clouds together: "34 requests, 1.2
  /// MB; 0.3 MB from the cache". Empty: nothing.
  const char* GetTraffic();

  /// Closes the file; the next update opens it again. Others that draw or read it keep it open.
  virtual void CloseStore();

protected:
  vtkPVPointFrontReader();
  ~vtkPVPointFrontReader() override;
  /// One error says what is wrong; no failures of the pipeline's besides.
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPVPointFrontReader(const vtkPVPointFrontReader&) = delete;
  void operator=(const vtkPVPointFrontReader&) = delete;

  std::string StoreFacts;
  std::string Traffic;
};

#endif
