#pragma once

#include "BuildOrder.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

namespace pointfront
{

/// A build on threads of its own, watched from the caller's: VTK's observers, and Python's above
/// all, may only be called from there.
class BuildThread
{
public:
  /// The caller's news between two looks.
  struct News
  {
    Progress progress;
    bool preview = false; ///< a new version of the preview is there
  };
  /// Called from the thread that called run(), some ten times a second; false cancels.
  using Watch = std::function<bool(const News&)>;

  /// carryOut(), until all is done.
  Result<BuildReport> run(const BuildOrder& order, const Watch& watch);

private:
  Result<BuildReport> build(BuildOrder order);
  bool report(const Progress& progress);

  std::atomic<bool> cancelled_{ false };
  std::mutex mutex_; // guards what follows
  std::condition_variable changed_;
  News news_; ///< the latest progress; a preview until it is told
  std::optional<Result<BuildReport>> outcome_;
};

} // namespace pointfront
