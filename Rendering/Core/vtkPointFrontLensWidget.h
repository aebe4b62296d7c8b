/**
 * @class vtkPointFrontLensWidget
 * @brief a lens of a style that follows the mouse
 *
 * While it is enabled, a circle or rectangle of a vtkPointFrontStyle (AddCircleLens and the like)
 * lies where the mouse is, and Ctrl with the mouse wheel makes a circle larger and smaller. The
 * mouse's buttons stay with the interactor style. The key 'l' turns it on and off
 * (KeyPressActivation of vtkInteractorObserver). InteractionEvent tells of each change; the widget
 * renders the window.
 *
 * Use: style->AddCircleLens(0, 0, 120); widget->SetStyle(style); widget->SetInteractor(...);
 * widget->On().
 */
#ifndef vtkPointFrontLensWidget_h
#define vtkPointFrontLensWidget_h

#include "pointfrontRenderingCoreModule.h" // for the export macro
#include "vtkInteractorObserver.h"
#include "vtkSmartPointer.h" // for the style

class vtkPointFrontStyle;

class POINTFRONTRENDERINGCORE_EXPORT vtkPointFrontLensWidget : public vtkInteractorObserver
{
public:
  static vtkPointFrontLensWidget* New();
  vtkTypeMacro(vtkPointFrontLensWidget, vtkInteractorObserver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * On and off. Turning it on needs an interactor.
   */
  void SetEnabled(int enabling) override;

  ///@{
  /**
   * Whose lens it moves.
   */
  void SetStyle(vtkPointFrontStyle* style);
  vtkPointFrontStyle* GetStyle() const;
  ///@}

  ///@{
  /**
   * Which of the style's lenses; the first by default.
   */
  vtkSetMacro(Lens, int);
  vtkGetMacro(Lens, int);
  ///@}

  ///@{
  /**
   * How small and how large the wheel makes a circle: radius in pixels, 8 and 2000 by default.
   */
  vtkSetClampMacro(MinimumRadius, double, 1.0, 1e6);
  vtkGetMacro(MinimumRadius, double);
  vtkSetClampMacro(MaximumRadius, double, 1.0, 1e6);
  vtkGetMacro(MaximumRadius, double);
  ///@}

protected:
  vtkPointFrontLensWidget();
  ~vtkPointFrontLensWidget() override;

private:
  vtkPointFrontLensWidget(const vtkPointFrontLensWidget&) = delete;
  void operator=(const vtkPointFrontLensWidget&) = delete;

  static void ProcessEvents(vtkObject* caller, unsigned long event, void* client, void* data);
  void FollowMouse();
  void Resize(double factor);
  bool HasLens() const;
  void Show();

  vtkSmartPointer<vtkPointFrontStyle> Style;
  int Lens = 0;
  double MinimumRadius = 8.0;
  double MaximumRadius = 2000.0;
};

#endif
