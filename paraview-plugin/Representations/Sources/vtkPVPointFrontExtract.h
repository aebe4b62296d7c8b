/**
 * @class vtkPVPointFrontExtract
 * @brief vtkPointFrontExtract as ParaView's filter: regions as its widgets give them, and what a
 * rank has read
 *
 * The input is a vtkPointFrontReader's output as it is. Port 1, optional: a selection "through" a
 * view, whose frustum is a region. Field data of the output, each of the rank alone:
 * "points_chosen" (with CountOnly, too), "points_read" and "bytes_read" (from the disk).
 */
#ifndef vtkPVPointFrontExtract_h
#define vtkPVPointFrontExtract_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPointFrontExtract.h"
#include "vtkSmartPointer.h" // for the region

class vtkAlgorithmOutput;
class vtkImplicitFunction;
class vtkPointFrontStore;
class vtkSelection;

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPVPointFrontExtract : public vtkPointFrontExtract
{
public:
  static vtkPVPointFrontExtract* New();
  vtkTypeMacro(vtkPVPointFrontExtract, vtkPointFrontExtract);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A box (turned or not), a sphere, or the side of a plane that its normal points away from. On by
   * default, and without a region an error.
   */
  vtkSetMacro(UseRegion, bool);
  vtkGetMacro(UseRegion, bool);
  void SetRegion(vtkImplicitFunction* region);
  ///@}

  void SetSelectionConnection(vtkAlgorithmOutput* selection);
  void RemoveAllSelections() { this->SetSelectionConnection(nullptr); }

  vtkMTimeType GetMTime() override; ///< the region's too

protected:
  vtkPVPointFrontExtract();
  ~vtkPVPointFrontExtract() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPVPointFrontExtract(const vtkPVPointFrontExtract&) = delete;
  void operator=(const vtkPVPointFrontExtract&) = delete;

  bool ChooseRegion(vtkSelection* selection);

  bool UseRegion = true;
  vtkSmartPointer<vtkImplicitFunction> Region;
};

#endif
