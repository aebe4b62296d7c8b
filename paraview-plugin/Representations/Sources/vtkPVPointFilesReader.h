/**
 * @class vtkPVPointFilesReader
 * @brief opens point files in ParaView: builds a store beside them, or uses the one that is there
 *
 * Files of all families that PointFront reads (LAS, LAZ, PLY, PCD, text); several are one cloud.
 * The first update builds a store, with progress, and can be aborted: then it leaves nothing and
 * gives nothing. After that this is a vtkPVPointFrontReader of that store.
 *
 * Where somebody asks GetNeedsUpdate() again and again, as ParaView's application does of a source
 * with the hint LiveSource, the first update returns as soon as there is a preview of the store,
 * and the build goes on beside: the output is the preview's, the view refines with it, and when the
 * build has ended GetNeedsUpdate() asks for the update that gives the store. Elsewhere (pvbatch,
 * Python) an update returns with the whole store.
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

#include "BackgroundBuild.h" // for the member
#include "vtkPVPointFrontReader.h"

#include <chrono> // for the time
#include <memory> // for the member
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

  ///@{
  /// Return with a preview where somebody asks GetNeedsUpdate(). On by default.
  vtkSetMacro(ShowPreview, bool);
  vtkGetMacro(ShowPreview, bool);
  ///@}
  /// Fewest points whose build has a preview (vtkPointFrontBuilder::SetPreviewPoints).
  vtkSetClampMacro(PreviewPoints, vtkIdType, 0, VTK_ID_MAX);

  /// Whether a build whose preview was shown has ended since this was asked. Asked on the first
  /// rank; cheap.
  bool GetNeedsUpdate();
  /// Ends a build that is going on. The next update gives nothing, and those after it as well until
  /// a property that the build depends on is changed.
  void CancelBuild();
  /// Ends such a build, too.
  void CloseStore() override;
  /// The state of the build: "sorting, 43 %"; empty where nothing is built.
  std::string GetBuildState() const;

  /// While a preview is shown, every update looks what has become of the build.
  vtkMTimeType GetMTime() override;

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
  bool ShowPreview = true;
  vtkIdType PreviewPoints = 4000000;

private:
  vtkPVPointFilesReader(const vtkPVPointFilesReader&) = delete;
  void operator=(const vtkPVPointFilesReader&) = delete;

  std::string StorePath() const;
  /// Why the store that is there cannot be used; empty: it can.
  std::string Misfit(const std::string& store) const;
  /// The same of what can be seen of the store.
  std::string VisibleMisfit(const std::string& store) const;
  /// The outcome of an update.
  enum Outcome
  {
    NOTHING,
    PREVIEW,
    STORE
  };
  /// On the first rank: starts the build if there is none, and waits for what can be shown.
  Outcome BuildOrWait(const std::string& store);
  /// The same, known to all ranks.
  Outcome Agree(const std::string& store);
  bool StartBuild(const std::string& store);
  Outcome EndBuild(const pointfront::BackgroundBuild::State& ended, const std::string& store);
  void Choose(vtkPointFrontBuilder* builder, const std::string& store) const;
  /// All that the build depends on.
  std::string Order(const std::string& store) const;
  /// The part of it that decides what is in the store.
  std::string Wanted(const std::string& store) const;

  std::vector<std::string> PointFileNames;
  std::unique_ptr<pointfront::BackgroundBuild> Running; ///< first rank
  std::string Cancelled; ///< the order that is not to be built again
  std::string Shown; ///< the wishes for the store that is the output
  std::chrono::steady_clock::time_point Asked; ///< GetNeedsUpdate()
  bool Followed = false; ///< the running build has a preview to return with
  bool Previewing = false; ///< on all ranks: the output is a preview's
  bool Unseen = false; ///< the build has ended, and GetNeedsUpdate() has not told so
  vtkTimeStamp Looked;
};

#endif
