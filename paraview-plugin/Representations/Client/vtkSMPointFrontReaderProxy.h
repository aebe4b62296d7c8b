/**
 * @class vtkSMPointFrontReaderProxy
 * @brief the client's end of vtkPVPointFrontReader and vtkPVPointFilesReader
 *
 * ParaView's application keeps a source in memory when a user has deleted it, whatever it is. A
 * cloud that is deleted has its file closed and its build cancelled all the same: when its last
 * name is taken from it. Client only, main thread.
 */
#ifndef vtkSMPointFrontReaderProxy_h
#define vtkSMPointFrontReaderProxy_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkSMSourceProxy.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkSMPointFrontReaderProxy : public vtkSMSourceProxy
{
public:
  static vtkSMPointFrontReaderProxy* New();
  vtkTypeMacro(vtkSMPointFrontReaderProxy, vtkSMSourceProxy);

protected:
  vtkSMPointFrontReaderProxy();
  ~vtkSMPointFrontReaderProxy() override;

  void CreateVTKObjects() override;

private:
  vtkSMPointFrontReaderProxy(const vtkSMPointFrontReaderProxy&) = delete;
  void operator=(const vtkSMPointFrontReaderProxy&) = delete;
};

#endif
