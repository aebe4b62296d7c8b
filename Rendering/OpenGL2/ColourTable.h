#pragma once

#include "pointfront/Style/PointColouring.h"

#include <vtkNew.h>
#include <vtkType.h>

#include <vector>

class vtkOpenGLRenderWindow;
class vtkScalarsToColors;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace pointfront
{

/// A VTK lookup table or transfer function as a texture; see glsl/ColourTable.glsl. Remade when the
/// table, its range or the colouring changes: no point is touched by it.
/// Values      integers of few different values get one entry each, so that indexed tables, class
///             colours and annotations are exact. A table of n colours gets n entries, a
///             continuous function 8192. Below- and above-range and NaN colours are VTK's own.
/// Threads     that of the GL context, current in all functions but the constructor.
class ColourTable
{
public:
  ColourTable();
  ~ColourTable();

  /// What the table says now. `reference` is the store's z of the frame's reference point
  /// (elevations are relative to it).
  void update(vtkOpenGLRenderWindow* window, vtkScalarsToColors* table,
    const PointColouring& colouring, vtkMTimeType tableTime);
  void activate(vtkShaderProgram* program, const PointColouring& colouring, double referenceZ);
  void deactivate();
  void release(vtkWindow* window);

private:
  void sampleIntegers(vtkScalarsToColors* table, const PointColouring& colouring);
  void sampleRange(vtkScalarsToColors* table);
  void append(vtkScalarsToColors* table, const std::vector<double>& values);

  vtkNew<vtkTextureObject> texture_;
  std::vector<unsigned char> texels_;
  PointColouring colouring_;
  vtkMTimeType time_ = 0;
  int size_ = 0;         ///< entries without the three special ones
  double low_ = 0.0;     ///< world value of the first entry's lower end
  double scale_ = 1.0;   ///< entries per unit, or per decade
  double logSign_ = 0.0; ///< 0: linear
  double logLow_ = 0.0;
};

} // namespace pointfront
