/**
 * @class vtkPVPointFrontClasses
 * @brief the object classes of the store that a representation draws, gathered by the client
 *
 * ParaView pulls information properties from the client where a proxy exists there too, and the
 * client of a server has no input. Asked of vtkPointFrontRepresentation on the server's root.
 */
#ifndef vtkPVPointFrontClasses_h
#define vtkPVPointFrontClasses_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPVInformation.h"

#include <string>
#include <vector>

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPVPointFrontClasses : public vtkPVInformation
{
public:
  static vtkPVPointFrontClasses* New();
  vtkTypeMacro(vtkPVPointFrontClasses, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void CopyFromObject(vtkObject* representation) override;
  /// The first process that knows some: all see the same store.
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;

  /// In the order of the store. Empty while there is no input.
  const std::vector<std::string>& GetNames() const { return this->Names; }

protected:
  vtkPVPointFrontClasses();
  ~vtkPVPointFrontClasses() override;

private:
  vtkPVPointFrontClasses(const vtkPVPointFrontClasses&) = delete;
  void operator=(const vtkPVPointFrontClasses&) = delete;

  std::vector<std::string> Names;
};

#endif
