/**
 * @class vtkPointFrontPickingHelper
 * @brief where a pick meets what is shown: of a store, the picked point
 *
 * ParaView asks for the point under the mouse (ruler, pick of a centre, placement of widgets) in
 * two steps: what is selected at that pixel, and where the ray meets it. A cloud has no surface
 * that a ray meets, so the picked point is the answer, snapped or not. Anything but a store
 * is picked as ever.
 */
#ifndef vtkPointFrontPickingHelper_h
#define vtkPointFrontPickingHelper_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPVRayCastPickingHelper.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontPickingHelper
  : public vtkPVRayCastPickingHelper
{
public:
  static vtkPointFrontPickingHelper* New();
  vtkTypeMacro(vtkPointFrontPickingHelper, vtkPVRayCastPickingHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Hides the superclass's, which the server manager would call.
  void ComputeIntersection();

protected:
  vtkPointFrontPickingHelper();
  ~vtkPointFrontPickingHelper() override;

private:
  vtkPointFrontPickingHelper(const vtkPointFrontPickingHelper&) = delete;
  void operator=(const vtkPointFrontPickingHelper&) = delete;
};

#endif
