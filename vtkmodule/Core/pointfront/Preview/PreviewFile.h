#pragma once

#include "pointfront/Base/Result.h"

#include <memory>
#include <string>

namespace pointfront
{

/// The file of a preview while its build runs: replaced as a whole, locked as long as this object
/// lives, removed with it. A reader that meets an unlocked preview knows that its build was killed
/// (PointStore::open refuses it), and the next build of the same store removes it.
/// File systems without locks (some network shares): a killed build's preview opens as what its
/// record says, a preview, until the next build of that store.
/// Threads  one at a time.
class PreviewFile
{
public:
  /// Claims the preview of the store at `storePath`. Removes the preview of a killed build.
  /// Errors  Unwritable: another build is writing that store now, or something that is not a
  ///         preview has its name.
  static Result<std::unique_ptr<PreviewFile>> claim(const std::string& storePath);
  ~PreviewFile();
  PreviewFile(const PreviewFile&) = delete;
  PreviewFile& operator=(const PreviewFile&) = delete;

  const std::string& path() const { return path_; }
  /// Where the next version is written before replace().
  const std::string& nextPath() const { return nextPath_; }
  /// The file at nextPath() becomes the preview. Readers of the version before keep it.
  Result<void> replace();

private:
  explicit PreviewFile(std::string path);
  std::string path_;
  std::string nextPath_;
  int locked_ = -1; ///< descriptor of the preview, holds the lock; -1: there is none yet
};

} // namespace pointfront
