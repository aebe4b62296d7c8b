/**
 * @class vtkPointFrontStyle
 * @brief how a point cloud is drawn: a default, what differs for each object class, and shading
 *
 * A class takes from the default what is not set for it. What the default does not set is: points
 * that close the surface, in the colour that tells most about the store. Every change calls
 * Modified(), shows in the next frame of a mapper that draws by the style, and rebuilds no
 * positions. One style can serve several mappers. docs/user/styles.md has the words.
 *
 * Setters that are given something wrong report it with vtkErrorMacro, return false and change
 * nothing. `objectClass` is a code from 0 to 255, or DEFAULT_CLASS.
 */
#ifndef vtkPointFrontStyle_h
#define vtkPointFrontStyle_h

#include "pointfrontCommonModule.h" // for the export macro
#include "vtkObject.h"

#include <memory> // for the sheet
#include <string> // for texts

namespace pointfront
{
struct FrameLens;
struct FrameLook;
struct LayerStyle;
struct StyleLens;
struct StyleSheet;
} // namespace pointfront

class vtkImageData;

class POINTFRONTCOMMON_EXPORT vtkPointFrontStyle : public vtkObject
{
public:
  static vtkPointFrontStyle* New();
  vtkTypeMacro(vtkPointFrontStyle, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Stands for the default of all classes where a class is expected.
   */
  static constexpr int DEFAULT_CLASS = -1;

  ///@{
  /**
   * "points", "splats", "spheres", "silhouettes", "solid" or "ewa".
   */
  bool SetTechnique(const std::string& name, int objectClass = -1);
  std::string GetTechnique(int objectClass = -1) const;
  ///@}

  /**
   * "draft", "balanced" or "exact", an SSIM ("0.95") or milliseconds of a frame ("33ms"):
   * technique, blending and accuracy together (vtkPointFrontMapper::SetQuality sets the error that
   * belongs to it as well).
   */
  bool SetQuality(const std::string& name, int objectClass = -1);

  ///@{
  /**
   * An attribute's name, "#rrggbb", "auto", or a colour as in JSON: {"attribute": "local_height",
   * "map": "viridis", "range": [0, 20]}. GetColor gives JSON.
   */
  bool SetColor(const std::string& color, int objectClass = -1);
  std::string GetColor(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * Diameter in pixels, diameter in the store's units, a factor of the radius that closes the
   * surface, or a factor of a radius that an attribute holds. GetSize gives JSON.
   */
  bool SetSizePixels(double diameter, int objectClass = -1);
  bool SetSizeWorld(double diameter, int objectClass = -1);
  bool SetSizeSpacing(double factor, int objectClass = -1);
  bool SetSizeAttribute(const std::string& attribute, double factor = 1.0, int objectClass = -1);
  std::string GetSize(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * A class that is not visible is neither loaded nor drawn.
   */
  bool SetVisibility(bool visible, int objectClass = -1);
  bool GetVisibility(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * From 0 to 1. A translucent class is one surface: other classes show through its nearest points,
   * its own farther points do not.
   */
  bool SetOpacity(double opacity, int objectClass = -1);
  double GetOpacity(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * Splats are blended in two passes.
   */
  bool SetBlended(bool blended, int objectClass = -1);
  bool GetBlended(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * "#rrggbb": of the outline of silhouettes, black by default; of the upper and the lower end of a
   * solid's walls. Walls without a color have that of their point: "" for both.
   */
  bool SetRimColor(const std::string& color, int objectClass = -1);
  std::string GetRimColor(int objectClass = -1) const;
  bool SetWallColor(const std::string& upper, const std::string& lower, int objectClass = -1);
  std::string GetWallColorUpper(int objectClass = -1) const;
  std::string GetWallColorLower(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * The condition that points must meet to be drawn, for a class or for all classes without a
   * condition of their own: "return_number == 1 and z < 50". Empty: all.
   */
  bool SetFilter(const std::string& where, int objectClass = -1);
  std::string GetFilter(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * The epoch of a collection whose points are drawn, for a class or for all classes without one of
   * their own: "2024-07"; "" is that of tiles that name none. SetLensStyle() takes another one for
   * the inside of a lens: {"epoch": "2019"}. A collection without that epoch is the mapper's error.
   * ShowAllEpochs() undoes it, as at first; GetEpoch() is empty then, too.
   */
  bool SetEpoch(const std::string& epoch, int objectClass = -1);
  bool ShowAllEpochs(int objectClass = -1);
  std::string GetEpoch(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * A further condition that holds for all classes.
   */
  bool SetCommonFilter(const std::string& where);
  std::string GetCommonFilter() const;
  ///@}

  ///@{
  /**
   * Light on points that have a normal, and how much of it comes from everywhere and from the
   * lights. By default only spheres are lit, by 0.3 and 0.7.
   */
  bool SetLit(bool lit, int objectClass = -1);
  bool GetLit(int objectClass = -1) const;
  bool SetAmbient(double share, int objectClass = -1);
  double GetAmbient(int objectClass = -1) const;
  bool SetDiffuse(double share, int objectClass = -1);
  double GetDiffuse(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * Eye-dome lighting: its strength (0, the default, turns it off, 0.4 is usual), and how far it
   * looks.
   */
  bool SetEyeDomeStrength(double strength, int objectClass = -1);
  double GetEyeDomeStrength(int objectClass = -1) const;
  bool SetEyeDomeRadius(double pixels, int objectClass = -1);
  double GetEyeDomeRadius(int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * Filling of holes between points; off by default.
   */
  bool SetFillHoles(bool fill);
  bool GetFillHoles() const;
  ///@}

  ///@{
  /**
   * A lens that shows what it covers in other styles: a circle or a rectangle, in pixels from the
   * lower left corner of the viewport (as events give them); a mask that is stretched over the
   * viewport, one component, not 0 where the lens is; or everything that discs of `radius` (the
   * store's units) around the points of a class cover. A lens draws as outside until SetLensStyle()
   * sets another style. Returns the lens' number, -1 where something is wrong. Where lenses overlap
   * the later one lies on top.
   */
  int AddCircleLens(double x, double y, double radius);
  int AddRectangleLens(double x, double y, double width, double height);
  int AddMaskLens(vtkImageData* mask);
  int AddClassLens(int objectClass, double radius);
  ///@}

  ///@{
  /**
   * The differences inside a lens, for a class or for all classes without differences of their own:
   * an object as `default` or a class has in JSON, {"visible": false, "color": "intensity"}. It
   * replaces earlier differences; GetLensStyle gives JSON.
   */
  bool SetLensStyle(int lens, const std::string& style, int objectClass = -1);
  std::string GetLensStyle(int lens, int objectClass = -1) const;
  ///@}

  ///@{
  /**
   * The centre of a circle or a rectangle, and the radius of a circle, in pixels; with 0 it covers
   * nothing. Moving a lens resolves no styles and draws nothing outside of it anew.
   */
  bool SetLensCenter(int lens, double x, double y);
  double GetLensCenterX(int lens) const;
  double GetLensCenterY(int lens) const;
  bool SetLensRadius(int lens, double radius);
  double GetLensRadius(int lens) const;
  ///@}

  ///@{
  /**
   * Removes lenses. Lenses behind a removed one get a lower number.
   */
  int GetNumberOfLenses() const;
  bool RemoveLens(int lens);
  void RemoveAllLenses();
  ///@}

  ///@{
  /**
   * A class whose points stand out: they get a rim of `haloPx` pixels in a colour, "#rrggbb",
   * around their visible pixels, and their own colours get a share of it.
   */
  bool SetHighlight(
    int objectClass, const std::string& color, double haloPx = 2.0, double tint = 0.25);
  bool HasHighlight(int objectClass) const;
  bool RemoveHighlight(int objectClass);
  ///@}

  ///@{
  /**
   * Draws one class, or all classes, by the default again.
   */
  void ResetClass(int objectClass);
  void Reset();
  ///@}

  ///@{
  /**
   * The whole style as text. LoadJSON replaces it, or changes nothing where the text is wrong.
   */
  bool LoadJSON(const std::string& text);
  std::string SaveJSON() const;
  ///@}

#ifndef __VTK_WRAP__
  ///@{
  /**
   * For mappers and C++ programs. The sheet itself never changes: another one takes its place, so
   * who keeps it can tell by the pointer that there is something new.
   */
  const pointfront::StyleSheet& GetStyleSheet() const;
  std::shared_ptr<const pointfront::StyleSheet> GetSharedStyleSheet() const
  {
    return this->Sheet;
  }
  bool SetStyleSheet(const pointfront::StyleSheet& sheet);
  ///@}
#endif

protected:
  vtkPointFrontStyle();
  ~vtkPointFrontStyle() override;

private:
  vtkPointFrontStyle(const vtkPointFrontStyle&) = delete;
  void operator=(const vtkPointFrontStyle&) = delete;

  template <typename Change>
  bool ChangeStyle(int objectClass, const Change& change);
  template <typename Change>
  bool ChangeLight(int objectClass, const Change& change);
  template <typename Change>
  bool ChangeEyeDome(int objectClass, const Change& change);
  bool ChangeByJSON(int objectClass, const std::string& key, const std::string& json);
  bool IsClass(int objectClass);
  bool IsNumber(double value, double most, const char* what, int objectClass);
  const pointfront::StyleLens* LensOf(int lens) const;
  int AddLens(const pointfront::StyleLens& lens);
  template <typename Change>
  bool ChangeLens(int lens, const Change& change);
  pointfront::LayerStyle StyleOf(int objectClass) const;
  pointfront::FrameLook LookOf(int objectClass) const;

  std::shared_ptr<const pointfront::StyleSheet> Sheet;
};

#endif
