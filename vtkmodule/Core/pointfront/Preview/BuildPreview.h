#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Build/BuildWatch.h"
#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Preview/PointSample.h"
#include "pointfront/Preview/PreviewFile.h"
#include "pointfront/Store/PreviewRecord.h"
#include "pointfront/Threads/WorkerThread.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

struct PreviewOptions
{
  bool wanted = true;
  /// Smaller inputs are built in about the time that an overview takes.
  std::uint64_t leastPoints = 4000000;
  /// The share of the trees' CPU time so far that showing finished parts may take.
  double shareOfTime = 0.02;
  /// A later version of the sample is left out while the one before is younger than this: nobody
  /// looks at four pictures of a build that takes some seconds.
  double leastSeconds = 2.0;
  /// Called after each version with the preview's path; from a thread of the preview.
  std::function<void(const std::string&)> shown;
};

/// Shows a cloud while its store is built: a small store, the preview, lies beside it
/// (PreviewRecord.h). Its first version comes within seconds, from some chunks spread over all
/// inputs. The next versions come from a random share of everything that the build has read, unless
/// the one before is very young. While the trees are built, versions show finished parts in full,
/// out of the file that the build is writing, and that share of the other parts (PartialTrees.h).
/// The build's bytes do not depend on the preview.
/// Cost        the sample has at most a 256th of the points; versions with finished parts come as
///             often as PreviewOptions::shareOfTime lets them. Memory: a 16th of the build's limit,
///             at most 1 GiB, see heldBytes().
/// Errors      what goes wrong with a preview never ends the build: see warnings().
/// Guarantees  removed with this object; a killed build's does not open (PreviewFile).
/// Threads     called from one thread; runs one of its own while the build reads.
/// Source      Futterlieb et al. 2016, section 3.3.1: the first task generates an overview, later
///             ones recompute it (SMOOTH-1).
class BuildPreview final : private BuildWatch
{
public:
  /// Claims the preview's name. If no preview is wanted, or with few points or little memory, the
  /// object stays silent: all other functions then only pass their arguments on.
  /// Errors  PreviewFile::claim(): another build of this store is running.
  static Result<std::unique_ptr<BuildPreview>> create(
    const PointSources& sources, const BuildOptions& build, const PreviewOptions& options = {});
  ~BuildPreview() override;
  BuildPreview(const BuildPreview&) = delete;
  BuildPreview& operator=(const BuildPreview&) = delete;

  bool active() const { return capacity_ > 0; }
  const std::string& path() const { return file_->path(); }

  /// Reads some chunks on all threads and shows them. Reports as the phase "overview".
  void showOverview(const PointSources& sources, const ProgressFunction& progress = {});

  /// Builds the store from `sources` and shows its progress; `options` may leave the build less
  /// memory than create() was told, nothing else. The report has the warnings of the preview.
  Result<BuildReport> build(const PointSources& sources, const BuildOptions& options,
    const ProgressFunction& progress = {});

  /// The sources to build from: as these, which must outlive them, watched while they are read.
  PointSources watched(const PointSources& sources);
  /// Memory that the preview may take; passes and build have that much less.
  std::uint64_t heldBytes() const { return memoryBytes_; }

  /// Why there was no preview, or no later version of it; full sentences.
  std::vector<std::string> warnings() const;

private:
  class WatchedSource;
  BuildPreview(const BuildOptions& build, PreviewOptions options);
  void chooseCapacity(const PointSources& sources);
  void pickChunks(const PointSources& sources, const std::function<bool()>& goOn);
  void pointsWereRead(std::uint64_t points);
  void refine(const PointSources& sources);
  void show(const PointSources& originals, std::uint64_t pointsRead, unsigned threads,
    const std::function<bool()>& goOn);
  Result<void> write(const PointSources& originals, std::uint64_t pointsRead, unsigned threads,
    const std::function<bool()>& goOn);
  PreviewRecord recordOf(std::uint64_t pointsRead) const;
  void tell(const Result<void>& done);
  bool stopped() const;

  PointSources sample() override;
  bool due(std::size_t bytes) override;
  void show(PartialStore& store) override;

  BuildOptions build_;
  PreviewOptions options_;
  std::unique_ptr<PreviewFile> file_;
  std::uint64_t expected_ = 0; ///< points that the sources announce
  std::uint64_t chunks_ = 0;
  std::uint64_t memoryBytes_ = 0; ///< for the sample, building from it, and finished parts
  std::uint64_t capacity_ = 0; ///< points of the sample; 0: silent
  const PointSource* firstShown_ = nullptr; ///< first source that showOverview() was given
  /// When the last version was there. One thread at a time: who shows parts waits for refining_.
  std::chrono::steady_clock::time_point shownAt_;
  bool mixed_ = false; ///< the sample still holds points of the overview
  PointSample sample_;
  const PointSources* sources_ = nullptr; ///< that the build reads
  WorkerThread refiner_;
  // Times of the trees:
  double began_ = 0.0; ///< CPU seconds of the process when they were
  double spent_ = 0.0; ///< CPU seconds for versions with finished parts
  double estimate_ = 0.0; ///< for the next one
  bool tooLittleMemory_ = false;
  mutable std::mutex mutex_; // guards what follows
  std::condition_variable changed_;
  std::uint64_t read_ = 0;
  bool allRead_ = false; ///< the refiner begins nothing more
  bool refining_ = false; ///< it writes a version
  bool stop_ = false;
  std::vector<std::string> warnings_;
};

} // namespace pointfront
