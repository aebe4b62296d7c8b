#pragma once

#include "pointfront/Base/Result.h"

#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace pointfront
{

/// A store that a process of its own builds while the window is open: `pointfront build`, as a user
/// would call it. What is unfinished goes with this object; so does a store in a temporary folder.
/// Threads  one thread.
class StoreInTheMaking
{
public:
  enum class State
  {
    Reading, ///< there is nothing to show yet
    Preview, ///< see BuildPreview
    Whole,
    Failed
  };
  /// `keep`   where the store is to stay; empty: in a temporary folder.
  /// Errors   Unwritable: no folder, or no process.
  static Result<std::unique_ptr<StoreInTheMaking>> begin(
    const std::vector<std::string>& files, const std::string& keep);
  ~StoreInTheMaking();
  StoreInTheMaking(const StoreInTheMaking&) = delete;
  StoreInTheMaking& operator=(const StoreInTheMaking&) = delete;

  /// Looks at the disk and at the process.
  State look();
  /// The path of the store, or of its preview.
  std::string path() const;
  /// The message of the build when it failed.
  std::string failure() const;

private:
  StoreInTheMaking() = default;
  Result<void> start(const std::vector<std::string>& files);

  std::string folder_; ///< temporary
  std::string store_;
  pid_t process_ = -1; ///< -1: it has ended
  State state_ = State::Reading;
};

} // namespace pointfront
