#pragma once

#include "StoreInTheMaking.h"

#include "pointfront/Base/Result.h"

#include "vtkPointFrontStore.h"

#include <vtkSmartPointer.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Chooses the stores that stand for the user's files. Stores stand for themselves. Point files,
/// and folders of LAS and LAZ files, are shown at a glance, while a store of them is built; then by
/// the store's preview, and at last by the store.
class ShownFiles
{
public:
  /// `keep`       where a store that is built is to stay; empty: it goes with the window.
  /// `signalled`  ViewRequest::signalled, called before there is anything to remove.
  ShownFiles(std::string keep, std::function<bool()> signalled);

  /// Shows these from now on. A build of earlier ones ends.
  /// Errors  of a file that is no cloud: those of before stay.
  Result<void> name(const std::vector<std::string>& files);
  /// The stores that the window opens.
  const std::vector<std::string>& stores() const { return stores_; }
  /// Looks at the build. Nothing: the stores are those of before; else a sentence about the new
  /// ones.
  /// Errors  the build failed: once. What is shown stays.
  Result<std::optional<std::string>> look();
  bool building() const;
  /// A build runs, or its store is in a temporary folder: something is to be removed at the end.
  bool holdsFiles() const { return making_ != nullptr; }

private:
  std::string keep_;
  std::function<bool()> signalled_;
  std::vector<vtkSmartPointer<vtkPointFrontStore>> opened_; ///< so that each is opened once
  std::vector<std::string> own_; ///< those that stand for themselves
  std::vector<std::string> stores_;
  std::unique_ptr<StoreInTheMaking> making_;
  StoreInTheMaking::State state_ = StoreInTheMaking::State::Reading; ///< when it was last looked at
};

} // namespace pointfront
