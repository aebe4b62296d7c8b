/// Where the releases of VTK that host these modules differ: 9.1 (Debian 12), 9.2 (ParaView 5.11),
/// 9.3 (ParaView 5.13), 9.7. Nothing else asks for VTK's version, so what a further release changes
/// is found here.
#ifndef HostVTK_h
#define HostVTK_h

#include <vtkType.h>
#include <vtkVersionMacros.h>

/// OpenGL's functions are loaded by glad since VTK 9.4, by GLEW before. An argument of #include.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
#define POINTFRONT_OPENGL_LOADER <vtk_glad.h>
#else
#define POINTFRONT_OPENGL_LOADER <vtk_glew.h>
#endif

namespace pointfront
{

/// Whether somebody wants the update that runs to end. Since 9.2 that may also be an algorithm
/// further down the pipeline.
template <class Algorithm>
bool isAborted(Algorithm& algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220101)
  return algorithm.CheckAbort();
#else
  return algorithm.GetAbortExecute() != 0;
#endif
}

/// Makes room for so many tuples, or more; what is there stays.
template <class Array>
void reserveTuples(Array& array, vtkIdType tuples)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
  array.ReserveTuples(tuples);
#else
  if (tuples * array.GetNumberOfComponents() > array.GetSize()) // or it would be cut
  {
    array.Resize(tuples);
  }
#endif
}

/// Sets whether an extraction makes unstructured grids of hyper tree grids; 9.2 cannot be asked to.
template <class Extraction>
void convertHyperTreeGrids(Extraction& extraction, bool converted)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 20240101)
  extraction.SetHyperTreeGridToUnstructuredGrid(converted);
#else
  (void)extraction;
  (void)converted;
#endif
}

} // namespace pointfront

#endif
