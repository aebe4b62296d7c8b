/**
 * @class vtkSMPointFrontExtractProxy
 * @brief the client's end of vtkPVPointFrontExtract
 *
 * The region that the filter suggests at first is the box of its input, which is known when the
 * input has been updated. The application has done so before it makes a filter; for scripts, which
 * need not have, this class updates an input when it is set. Client only, main thread.
 */
#ifndef vtkSMPointFrontExtractProxy_h
#define vtkSMPointFrontExtractProxy_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkSMSourceProxy.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkSMPointFrontExtractProxy : public vtkSMSourceProxy
{
public:
  static vtkSMPointFrontExtractProxy* New();
  vtkTypeMacro(vtkSMPointFrontExtractProxy, vtkSMSourceProxy);

protected:
  vtkSMPointFrontExtractProxy();
  ~vtkSMPointFrontExtractProxy() override;

  void SetPropertyModifiedFlag(const char* name, int flag) override;

private:
  vtkSMPointFrontExtractProxy(const vtkSMPointFrontExtractProxy&) = delete;
  void operator=(const vtkSMPointFrontExtractProxy&) = delete;
};

#endif
