#include "RemoteOpener.h"

#include <utility>

namespace pointfront
{
namespace
{
constexpr std::chrono::seconds heldFor{ 3 };
}

std::shared_ptr<const ByteSource> RemoteOpener::known(const std::string& name) const
{
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto one = sources_.begin(); one != sources_.end();)
  {
    if (one->second.held && one->second.until < now)
    {
      one->second.held.reset();
    }
    one = one->second.source.expired() ? sources_.erase(one) : std::next(one);
  }
  const auto found = sources_.find(name);
  return found != sources_.end() ? found->second.source.lock() : nullptr;
}

std::string RemoteOpener::publicForm(const std::string& text) const
{
  const Result<Address> address = Address::parse(addressOf(text));
  return address ? rememberAddress(*address) : text;
}

Result<std::shared_ptr<const ByteSource>> RemoteOpener::open(
  const std::string& text, const FirstBytes& first) const
{
  const Result<Address> address = Address::parse(addressOf(text));
  if (!address)
  {
    return address.error();
  }
  const std::string name = rememberAddress(*address);
  if (std::shared_ptr<const ByteSource> source = known(name))
  {
    return source;
  }
  Result<Request> request = requestOf(*address);
  if (!request)
  {
    return request.error();
  }
  Result<std::shared_ptr<const RemoteSource>> opened = RemoteSource::open(
    std::make_unique<const Conversation>(name, std::move(*request), options_), first);
  if (!opened)
  {
    return opened.error();
  }
  const std::shared_ptr<const ByteSource> source = *opened;
  const std::lock_guard<std::mutex> lock(mutex_);
  sources_[name] = { source, source, std::chrono::steady_clock::now() + heldFor };
  return source;
}

void addRemoteOpeners()
{
  static const bool added = []
  {
    const auto opener = std::make_shared<const RemoteOpener>(RemoteOptions::ofEnvironment());
    for (const char* scheme : { "http", "https", "s3" })
    {
      ByteOpeners::ofProcess().add(scheme, opener);
    }
    return true;
  }();
  static_cast<void>(added);
}

} // namespace pointfront
