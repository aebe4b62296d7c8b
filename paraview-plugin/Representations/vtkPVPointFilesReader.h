/**
 * @class vtkPVPointFilesReader
 * @brief opens point files in ParaView: builds a store beside them, or uses the one that is there
 *
 * Files of all families that PointFront reads (LAS, LAZ, PLY, PCD, text); several are one cloud.
 * The first update builds a store, with progress, and can be aborted: then it leaves nothing and
 * gives nothing. After that this is a vtkPVPointFrontReader of that store.
 *
 * The store is StoreFile, or lies beside the first file: "town.laz.pfront", of several files
 * "a.laz-and-2-more-1c0e5d4f.pfront". One that is there is used if it is newer than all files and
 * has what the options ask for. If it does not fit, that is an error that says why, unless
 * ReplaceStore allows to build it again.
 *
 * On several ranks the first builds and the others wait. Options are those of `pointfront build`.
 */
#ifndef vtkPVPointFilesReader_h
#define vtkPVPointFilesReader_h

#include "vtkPVPointFrontReader.h"

#include <string> // for names
#include <vector> // for names

class vtkPointFrontBuilder;

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPVPointFilesReader : public vtkPVPointFrontReader
{
public:
  static vtkPVPointFilesReader* New();
  vtkTypeMacro(vtkPVPointFilesReader, vtkPVPointFrontReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The point files; not the store.
  void AddPointFileName(VTK_FILEPATH const char* fileName);
  void RemoveAllPointFileNames();

  /// 1 if it is a point file that is not opened in place (COPC) and no surface (PLY with faces).
  static int CanReadFile(VTK_FILEPATH const char* fileName);

  ///@{
  /// Where the store is, as the server sees it. Null or empty: beside the first file.
  vtkSetFilePathMacro(StoreFile);
  vtkGetFilePathMacro(StoreFile);
  ///@}

  ///@{
  /// Build again over a store that does not fit. Off by default.
  vtkSetMacro(ReplaceStore, bool);
  vtkGetMacro(ReplaceStore, bool);
  ///@}

  ///@{
  /// As in vtkPointFrontBuilder, with its numbers.
  vtkSetMacro(Structure, int);
  vtkSetMacro(Refinement, int);
  vtkSetMacro(Layers, int);
  vtkSetMacro(Normals, int);
  vtkSetMacro(LocalHeight, bool);
  vtkSetMacro(HeightAboveGround, bool);
  vtkSetMacro(Precision, double);
  vtkSetMacro(SkipFaultyFiles, bool);
  vtkSetStringMacro(AssumedCRS);
  ///@}
  /// Most memory of the build, MiB; 0: half of the machine's.
  vtkSetMacro(MemoryLimitMiB, int);

protected:
  vtkPVPointFilesReader();
  ~vtkPVPointFilesReader() override;
  /// Says nothing of a store that is not built yet.
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* StoreFile = nullptr;
  char* AssumedCRS = nullptr;
  bool ReplaceStore = false;
  int Structure = 0;
  int Refinement = 0;
  int Layers = 0;
  int Normals = 0;
  bool LocalHeight = false;
  bool HeightAboveGround = false;
  double Precision = 0.0;
  bool SkipFaultyFiles = false;
  int MemoryLimitMiB = 0;

private:
  vtkPVPointFilesReader(const vtkPVPointFilesReader&) = delete;
  void operator=(const vtkPVPointFilesReader&) = delete;

  std::string StorePath() const;
  /// Why the store that is there cannot be used; empty: it can.
  std::string Misfit(const std::string& store) const;
  bool Build(const std::string& store);
  void Choose(vtkPointFrontBuilder* builder, const std::string& store) const;

  std::vector<std::string> PointFileNames;
};

#endif
