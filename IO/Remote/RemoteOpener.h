#pragma once

#include "RemoteSource.h"

#include "pointfront/Disk/ByteOpeners.h"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace pointfront
{

/// Opens addresses of http, https and s3. A source that somebody holds, or that was opened a moment
/// ago, is the same for all who open its address: whoever asks which format a file has, and then
/// opens it, asks the server once.
class RemoteOpener final : public ByteOpener
{
public:
  explicit RemoteOpener(RemoteOptions options)
    : options_(options)
  {
  }
  std::string publicForm(const std::string& address) const override;
  Result<std::shared_ptr<const ByteSource>> open(
    const std::string& address, const FirstBytes& first) const override;

private:
  struct Known
  {
    std::weak_ptr<const ByteSource> source;
    std::shared_ptr<const ByteSource> held; ///< until `until`
    std::chrono::steady_clock::time_point until;
  };
  std::shared_ptr<const ByteSource> known(const std::string& name) const;

  const RemoteOptions options_;
  mutable std::mutex mutex_; ///< guards all that follows
  mutable std::map<std::string, Known> sources_; ///< by their public forms
};

/// Makes this process open http, https and s3. Again is once.
void addRemoteOpeners();

} // namespace pointfront
