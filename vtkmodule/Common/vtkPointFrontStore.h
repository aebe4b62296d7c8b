/**
 * @class vtkPointFrontStore
 * @brief an open point store, shared by every reader and mapper of this process that names it
 *
 * A store is opened once per process and file: Open() gives the same object for the same file until
 * the last reference is gone. It owns the store's residency (decoded nodes in host memory), so
 * several views of one cloud share what is loaded. All stores of the process are loaded by one
 * scheduler: its threads, its host memory and the order of requests are shared, however many
 * stores are open, and memory goes to the largest errors on screen.
 *
 * In the pipeline a store travels as a name: vtkPointFrontReader puts its absolute path into the
 * field data of its output (array "PointFrontStore"), and vtkPointFrontMapper finds the store by
 * that name. The name survives shallow and deep copies, filters that pass field data on and
 * ParaView's delivery.
 */
#ifndef vtkPointFrontStore_h
#define vtkPointFrontStore_h

#include "pointfrontCommonModule.h" // for the export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Open
#include "vtkStdString.h" // for names

#include <memory> // for the kernel objects
#include <string> // for paths

class vtkDataObject;
namespace pointfront
{
class Residency;
class ResidencyShare;
class StoredCloud;
class StoredCloudFormats;
} // namespace pointfront

class POINTFRONTCOMMON_EXPORT vtkPointFrontStore : public vtkObject
{
public:
  vtkTypeMacro(vtkPointFrontStore, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The open store of that file or address ("https://..."): the one that is open already, or a new
   * one. Null on failure; the reason (what, where, what to try) is then in `error`, without what is
   * secret in an address.
   */
  static vtkSmartPointer<vtkPointFrontStore> Open(
    VTK_FILEPATH const char* fileName, vtkStdString& error);

  ///@{
  /**
   * The name of the store in an object's field data, and the store of that name.
   */
  static const char* FieldName() { return "PointFrontStore"; }
  static void SetStoreName(vtkDataObject* data, const char* fileName);
  static vtkStdString GetStoreName(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * A preview is the store that a running build shows meanwhile (docs/adr/0011). Its successor is
   * the next version of it, or the finished store once the build has ended; null while there is
   * none. HasSuccessor() looks at the disk four times a second at most, GetSuccessor() each time.
   * Open() with a preview's name gives the finished store when the preview is gone.
   */
  bool IsPreview() const;
  bool HasSuccessor();
  vtkSmartPointer<vtkPointFrontStore> GetSuccessor();
  ///@}

  /// Absolute path of the file, or the address without user, password and query: a mark stands for
  /// them, and Open() takes it in this process.
  const char* GetFileName() const;
  /// Bounds of all points (world, tight), without reading any of them. Without points those of
  /// vtkMath::UninitializeBounds().
  void GetBounds(double bounds[6]) const;
  vtkIdType GetNumberOfPoints() const;
  /// Points of all stores that are open in this process.
  static vtkIdType GetNumberOfPointsOfAllStores();
  ///@{
  /**
   * Traffic of this process with servers so far, of all stores behind addresses together: requests
   * (those after a fault or a redirection, too), bytes that were fetched, and bytes that came from
   * the cache on the disk instead. 0 for files.
   */
  static vtkTypeInt64 GetNumberOfFarRequests();
  static vtkTypeInt64 GetNumberOfFarBytes();
  static vtkTypeInt64 GetNumberOfCachedBytes();
  ///@}
  int GetNumberOfAttributes() const;
  const char* GetAttributeName(int attribute) const;

  ///@{
  /**
   * Object classes with a tree of their own: name ("ground", "building" ...) and number in the
   * source. A store without layers has one, "all", whose number is -1. Null and -1 out of range.
   */
  int GetNumberOfObjectClasses() const;
  const char* GetObjectClassName(int index) const;
  int GetObjectClassNumber(int index) const;
  ///@}

  ///@{
  /**
   * Host memory for decoded nodes of all stores of this process, bytes. Set it once; it holds
   * whatever stores are opened. If it was never set it is 1 GiB, or the largest budget that was set
   * for a single store.
   */
  static void SetProcessMemoryBudget(vtkTypeInt64 bytes);
  static vtkTypeInt64 GetProcessMemoryBudget();
  ///@}

  ///@{
  /**
   * The part of the process's host memory that decoded nodes of this store may take, bytes.
   * Default: all of it.
   */
  void SetHostMemoryBudget(vtkTypeInt64 bytes);
  vtkTypeInt64 GetHostMemoryBudget() const;
  ///@}

#ifndef __VTK_WRAP__
  /// The kinds of stored clouds that Open() opens: all that this build carries, and what was added.
  static pointfront::StoredCloudFormats& GetFormats();
  /// The kernel's objects, for modules of ours. Never null.
  const std::shared_ptr<const pointfront::StoredCloud>& GetStore() const;
  pointfront::Residency& GetResidency() const;
  /// The object that fronts join: it owns the residency and merges the wishes of the fronts.
  pointfront::ResidencyShare& GetResidencyShare() const;
#endif

protected:
  vtkPointFrontStore();
  ~vtkPointFrontStore() override;
  /// Leaves the registry before the last reference goes: Open() must not find what is closing.
  void UnRegisterInternal(vtkObjectBase* holder, vtkTypeBool check) override;

private:
  vtkPointFrontStore(const vtkPointFrontStore&) = delete;
  void operator=(const vtkPointFrontStore&) = delete;

  static vtkSmartPointer<vtkPointFrontStore> OpenFile(const std::string& path, std::string& error);
  static vtkSmartPointer<vtkPointFrontStore> Made(const std::string& path, std::string& error);

  struct Content;
  std::unique_ptr<Content> Internals;
};

#endif
