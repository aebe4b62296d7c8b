/**
 * @class vtkPointFrontEncodeSelection
 * @brief what the view selected of a store becomes a selection of points by their global ids
 *
 * The mapper's hardware selection gives ids of the store (vtkPointFrontMapper). ParaView takes
 * them for row numbers of the representation's input, on the process that drew them. They are
 * neither: most of them are in no overview, and any process can read them. Global ids say so, and
 * the reader's output carries them ("point_id"). Cells that are selected are points as well.
 * Whatever else was selected stays as it is.
 *
 * Client only. Comes by VTK's object factory, as ParaView provides for, once Register() was called.
 */
#ifndef vtkPointFrontEncodeSelection_h
#define vtkPointFrontEncodeSelection_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPVEncodeSelectionForServer.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontEncodeSelection
  : public vtkPVEncodeSelectionForServer
{
public:
  static vtkPointFrontEncodeSelection* New();
  vtkTypeMacro(vtkPointFrontEncodeSelection, vtkPVEncodeSelectionForServer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Makes ParaView ask this class. Any number of times.
  static void Register();

  bool ProcessSelection(vtkSelection* rawSelection, vtkSMRenderViewProxy* viewProxy,
    bool multipleSelectionsAllowed, vtkCollection* selectedRepresentations,
    vtkCollection* selectionSources, int modifier, bool selectBlocks) override;

protected:
  vtkPointFrontEncodeSelection();
  ~vtkPointFrontEncodeSelection() override;

private:
  vtkPointFrontEncodeSelection(const vtkPointFrontEncodeSelection&) = delete;
  void operator=(const vtkPointFrontEncodeSelection&) = delete;
};

#endif
