#pragma once

#include "RemoteSource.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Threads/OfProcess.h"

#include <future>
#include <memory>
#include <string>

namespace pointfront
{

/// Opens addresses of http, https and s3. A source that somebody holds, or that was opened a moment
/// ago, is the same for all who open its address: whoever asks which format a file has, and then
/// opens it, asks the server once. Several who open one address at a time wait for one opening.
/// Failures  are those of the next second, too. A server of which no answer comes is not asked
///           again, for any of its files, for as long as it took to find that out: a list of 1,000
///           files of a dead server waits once.
/// Settings  of an address (FarSettings) come before those of the environment.
/// Stop      StopOfReads of the thread that opens; another that waits for its opening opens then.
/// Fork      a child process has tables of its own.
class RemoteOpener final : public ByteOpener
{
public:
  explicit RemoteOpener(RemoteOptions options);
  ~RemoteOpener() override;
  std::string publicForm(const std::string& address) const override;
  std::string passedOn(const std::string& from, const std::string& to) const override;
  Result<std::shared_ptr<const ByteSource>> open(
    const std::string& address, const FirstBytes& first) const override;

private:
  struct Tables;
  using Opened = Result<std::shared_ptr<const ByteSource>>;

  Opened openFor(const std::string& name, const Address& address, const FirstBytes& first,
    Tables& tables, std::promise<Opened>& promise) const;
  Opened openNow(
    const std::string& name, const Address& address, const FirstBytes& first, Tables& tables) const;

  const RemoteOptions options_;
  const std::unique_ptr<OfProcess<Tables>> tables_;
};

/// Makes this process open http, https and s3. Again is once.
void addRemoteOpeners();

} // namespace pointfront
