#include "ShownFiles.h"

#include "GlancedFile.h"

#include "pointfront/Tiles/StoredCloudFormats.h"

#include <utility>

namespace pointfront
{

ShownFiles::ShownFiles(std::string keep, std::function<bool()> signalled)
  : keep_(std::move(keep))
  , signalled_(std::move(signalled))
{
  vtkPointFrontStore::GetFormats().add(std::make_shared<GlancedFileFormat>());
}

Result<void> ShownFiles::name(const std::vector<std::string>& files)
{
  std::vector<std::string> points;
  std::vector<std::string> own;
  std::vector<vtkSmartPointer<vtkPointFrontStore>> opened;
  for (const std::string& file : files)
  {
    vtkStdString why;
    opened.push_back(vtkPointFrontStore::Open(file.c_str(), why));
    if (!opened.back())
    {
      return makeError(Error::Kind::BadFormat, why);
    }
    const bool built =
      GlancedFileFormat::isPointFile(file) || GlancedFileFormat::isFolderOfPoints(file);
    (built ? points : own).push_back(file);
  }
  std::unique_ptr<StoreInTheMaking> making;
  if (!points.empty())
  {
    signalled_();
    Result<std::unique_ptr<StoreInTheMaking>> begun = StoreInTheMaking::begin(points, keep_);
    if (!begun)
    {
      return begun.error();
    }
    making = std::move(*begun);
  }
  making_ = std::move(making);
  opened_ = std::move(opened);
  state_ = StoreInTheMaking::State::Reading;
  own_ = std::move(own);
  stores_ = files;
  return {};
}

bool ShownFiles::building() const
{
  return making_ && state_ != StoreInTheMaking::State::Whole &&
    state_ != StoreInTheMaking::State::Failed;
}

Result<std::optional<std::string>> ShownFiles::look()
{
  using State = StoreInTheMaking::State;
  const State before = state_;
  if (!building() || (state_ = making_->look()) == before)
  {
    return std::optional<std::string>();
  }
  if (state_ == State::Failed)
  {
    return makeError(Error::Kind::Unwritable, making_->failure());
  }
  opened_.clear();
  const bool follows =
    before == State::Preview; // the view of a preview shows the store itself next
  stores_ = own_;
  stores_.push_back(making_->path());
  return std::optional<std::string>(follows ? ""
      : state_ == State::Preview            ? "a preview of the store that is being built"
                                            : "all points are here");
}

} // namespace pointfront
