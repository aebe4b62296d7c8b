/**
 * @class vtkPointFrontReader
 * @brief opens a `.pfront` store: an overview as vtkPolyData, and the store's name for
 * vtkPointFrontMapper
 *
 * The output holds an overview, so every VTK filter works at once: at most OverviewPoints points in
 * double coordinates, one vertex cell a point, the chosen attributes as point data. Each class and
 * each place has its share of the overview. The output's field data name the store (see
 * vtkPointFrontStore): vtkPointFrontMapper draws the whole cloud by that name.
 *
 * Attributes keep their type; one with a scale or an offset becomes double with both applied. "rgb"
 * has three bytes: 16-bit colour is reduced, for VTK takes only bytes as colours without a lookup
 * table. "elevation" (z) is always there. The active scalars are the first of "rgb" (unless it is
 * black), "classification", "intensity" and "elevation" (unless they are the same everywhere).
 * Global point ids ("point_id") are numbers in the store, as hardware selections of
 * vtkPointFrontMapper give them.
 * An aborted update leaves an empty output.
 *
 * Besides stores it opens everything that the process knows as a stored cloud: lists
 * (`.pfronts`), collections (`.pfcollection`) and folders of stores as one cloud, and, with
 * PointFront::IOLASIndex, indices of LAS files, COPC files, EPTs (`ept.json`) and folders of LAS
 * and LAZ files at a glance. A WarningEvent tells what differs among the parts of a cloud, and what
 * is left out.
 *
 * A name may be an address: "https://host/city.pfront", "s3://bucket/key". Messages, PrintSelf()
 * and the name that travels the pipeline are without what is secret in it. docs/user/remote.md says
 * how servers are asked.
 *
 * RequestInformation gives the bounds and array names of the whole cloud without reading points. Of
 * several time steps it gives the bounds of the first and the arrays of all. Pieces: the overview
 * is cut by nodes. Errors (ErrorCode, vtkErrorMacro): no file name, a missing, truncated or corrupt
 * file, a newer version.
 */
#ifndef vtkPointFrontReader_h
#define vtkPointFrontReader_h

#include "pointfrontIOStoreModule.h" // for the export macro
#include "vtkNew.h" // for the selection
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for the store

#include <functional> // for regions
#include <string> // for file names
#include <vector> // for file names

class vtkDataArraySelection;
class vtkIdTypeArray;
class vtkPointFrontStore;

class POINTFRONTIOSTORE_EXPORT vtkPointFrontReader : public vtkPolyDataAlgorithm
{
public:
  static vtkPointFrontReader* New();
  vtkTypeMacro(vtkPointFrontReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// @{ The store's file or address; if there are several, the first.
  void SetFileName(VTK_FILEPATH const char* fileName);
  VTK_FILEPATH const char* GetFileName() const;
  ///@}

  ///@{
  /**
   * Stores of the same cloud at several times, in their order: time steps 0, 1, 2 ... The output is
   * the overview of the store of the requested time. SetFileName() reduces the list to one file.
   * A collection whose tiles have several epochs has them as its time steps, if it is the only
   * file: their years (2019; "2019-07" is 2019.5) if all are dates, else 0, 1, 2 ... in the order
   * of their names. Without a requested time it is the cloud of all its tiles.
   */
  void AddFileName(VTK_FILEPATH const char* fileName);
  void RemoveAllFileNames();
  int GetNumberOfFileNames() const;
  VTK_FILEPATH const char* GetFileName(int time) const;
  ///@}

  ///@{
  /**
   * How addresses are read, where that differs from the environment's choice (docs/user/remote.md).
   * Offline: 1: no server is asked, and the cloud is what the cache has; 0: servers are asked; -1
   * (default): POINTFRONT_OFFLINE. CacheFolder: the folder of the cache, or "off"; null or empty
   * (default): POINTFRONT_CACHE. CacheSize: most bytes in it, 0 for no cache; -1 (default):
   * POINTFRONT_CACHE_SIZE. TimeLimit: seconds that a read waits while nothing comes; 0 (default):
   * POINTFRONT_REMOTE_TIMEOUT. They travel with the name of the cloud: mappers read with them. With
   * a path instead of an address they are an error.
   */
  vtkSetClampMacro(Offline, int, -1, 1);
  vtkGetMacro(Offline, int);
  vtkSetStdStringFromCharMacro(CacheFolder);
  vtkGetCharFromStdStringMacro(CacheFolder);
  vtkSetClampMacro(CacheSize, vtkTypeInt64, -1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(CacheSize, vtkTypeInt64);
  vtkSetClampMacro(TimeLimit, double, 0.0, 999999.0);
  vtkGetMacro(TimeLimit, double);
  ///@}

  /// 1 if the file begins like a store. Cheap, by content, silent. An address is asked for.
  static int CanReadFile(VTK_FILEPATH const char* fileName);

  ///@{
  /**
   * Most points of the overview. Default 200,000; 0: none, the handle only.
   */
  vtkSetClampMacro(OverviewPoints, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(OverviewPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * Which attributes the overview carries. All by default. (The mapper draws any attribute of the
   * store, whatever is chosen here.)
   */
  vtkDataArraySelection* GetPointDataArraySelection();
  int GetNumberOfPointArrays();
  const char* GetPointArrayName(int index);
  int GetPointArrayStatus(const char* name);
  void SetPointArrayStatus(const char* name, int status);
  ///@}

  /**
   * Reads points of the store by their numbers (which are the global point ids of hardware
   * selections), except those of the overview. `output` has the arrays of the overview and each
   * point once. With several `pieces`, each gets its share. Call it after UpdateInformation().
   * False, and an error, if the store has no point of a number, a node cannot be read, or
   * AbortExecute is on.
   */
  bool ReadPoints(vtkIdTypeArray* ids, int piece, int pieces, vtkPolyData* output);

#ifndef __VTK_WRAP__
  /**
   * The same for the points in a region: all of them, and further points of the nodes that reach
   * into the region. `overlaps` says whether a box reaches into it. False, and an error, also if
   * there are more than `mostPoints`.
   */
  bool ReadRegion(const std::function<bool(const double bounds[6])>& overlaps, vtkIdType mostPoints,
    int piece, int pieces, vtkPolyData* output);
#endif

  /// The open store: the first store after UpdateInformation(), the store of the output's time
  /// after Update(). Null before, or if it could not be opened.
  vtkPointFrontStore* GetStore();

  vtkMTimeType GetMTime() override;

protected:
  vtkPointFrontReader();
  ~vtkPointFrontReader() override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<std::string> FileNames;
  int Offline = -1;
  std::string CacheFolder;
  vtkTypeInt64 CacheSize = -1;
  double TimeLimit = 0.0;
  vtkIdType OverviewPoints = 200000;
  vtkNew<vtkDataArraySelection> PointDataArraySelection;
  vtkSmartPointer<vtkPointFrontStore> Store;

private:
  struct Step
  {
    double time;
    std::string name; ///< the store's
  };
  bool OpenStore(const std::string& name);
  /// The name with the settings of addresses; false, and an error, if it cannot have them.
  bool FindName(const std::string& name, std::string& named);
  void PrintSettings(ostream& os, vtkIndent indent) const;
  void FindSteps();
  const std::string& NameAt(vtkInformation* output, double& time) const;

  std::vector<Step> Steps; ///< ascending; none: one store without times

  struct Found;
  bool Fill(Found&& found, int piece, int pieces, vtkPolyData* output);

  vtkPointFrontReader(const vtkPointFrontReader&) = delete;
  void operator=(const vtkPointFrontReader&) = delete;
};

#endif
