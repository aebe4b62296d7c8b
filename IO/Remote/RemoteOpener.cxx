#include "RemoteOpener.h"

#include "TransferLoop.h"

#include "pointfront/Disk/FarSettings.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Threads/ForkHold.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds heldFor{ 3 };
constexpr std::chrono::seconds failedFor{ 1 };
constexpr std::chrono::milliseconds lookAgain{ 25 }; ///< whether it is stopped

template <typename Entries>
void dropPast(Entries& entries, Clock::time_point now)
{
  for (auto one = entries.begin(); one != entries.end();)
  {
    one = one->second.until < now ? entries.erase(one) : std::next(one);
  }
}

bool isOffline(const Address& address)
{
  const Result<FarSettings> settings = FarSettings::parse(address.settings);
  return settings && settings->offline.value_or(FarCache::offline());
}

std::shared_ptr<const ByteOpener> openerOfProcess()
{
  const RemoteOptions options = RemoteOptions::ofEnvironment();
  const ForkHold hold;
  static auto* const opener =
    new std::shared_ptr<const ByteOpener>(std::make_shared<const RemoteOpener>(options));
  return *opener;
}
} // namespace

/// All by public forms of addresses, but for servers: by their origins.
struct RemoteOpener::Tables
{
  struct Known
  {
    std::weak_ptr<const ByteSource> source;
    std::shared_ptr<const ByteSource> held; ///< until `until`
    Clock::time_point until;
  };
  struct Failed
  {
    Error error;
    Clock::time_point until;
  };
  struct Silent
  {
    Clock::time_point until;
  };

  std::mutex mutex; ///< guards all that follows
  std::map<std::string, Known> sources;
  std::map<std::string, Failed> failed;
  std::map<std::string, Silent> silent; ///< servers of which no answer came
  std::map<std::string, std::shared_future<Opened>> opening;

  std::optional<Opened> find(const std::string& name, const std::string& server, bool offline);
  void note(const std::string& name, const Opened& opened);
};

/// The outcome of an opening a moment ago, if it still counts. The caller has the lock.
std::optional<RemoteOpener::Opened> RemoteOpener::Tables::find(
  const std::string& name, const std::string& server, bool offline)
{
  const Clock::time_point now = Clock::now();
  dropPast(failed, now);
  dropPast(silent, now);
  for (auto one = sources.begin(); one != sources.end();)
  {
    if (one->second.held && one->second.until < now)
    {
      one->second.held.reset();
    }
    one = one->second.source.expired() ? sources.erase(one) : std::next(one);
  }
  const auto found = sources.find(name);
  std::shared_ptr<const ByteSource> source =
    found != sources.end() ? found->second.source.lock() : nullptr;
  if (source && source->isStillNamed())
  {
    return Opened(std::move(source));
  }
  if (source)
  {
    // Who opens it in several steps hears of the change in each; later ones get the new file.
    failed.insert_or_assign(name,
      Failed{ makeError(Error::Kind::Unreadable,
                "'" + name + "' has changed on its server while it was open; open it again"),
        now + failedFor });
    sources.erase(found);
  }
  if (offline)
  {
    return std::nullopt; // the cache may have it by now
  }
  if (const auto known = failed.find(name); known != failed.end())
  {
    return Opened(known->second.error);
  }
  if (silent.count(server) > 0)
  {
    return Opened(makeError(Error::Kind::Unreadable,
      "'" + name +
        "' cannot be read at the moment: its server gave no answer a moment ago; check the "
        "network and try again"));
  }
  return std::nullopt;
}

void RemoteOpener::Tables::note(const std::string& name, const Opened& opened)
{
  const Clock::time_point now = Clock::now();
  if (opened)
  {
    sources[name] = { *opened, *opened, now + heldFor };
  }
  else if (opened.error().kind != Error::Kind::Cancelled)
  {
    failed.insert_or_assign(name, Failed{ opened.error(), now + failedFor });
  }
}

RemoteOpener::RemoteOpener(RemoteOptions options)
  : options_(options)
  , tables_(std::make_unique<OfProcess<Tables>>())
{
}

RemoteOpener::~RemoteOpener() = default;

std::string RemoteOpener::publicForm(const std::string& text) const
{
  const Result<Address> address = Address::parse(addressOf(text));
  return address ? rememberAddress(*address) : text;
}

std::string RemoteOpener::passedOn(const std::string& from, const std::string& to) const
{
  const Result<Address> list = Address::parse(addressOf(from));
  Result<Address> file = Address::parse(addressOf(to));
  if (!list || !file)
  {
    return to;
  }
  const std::string named = file->textWithSettings();
  file->settings = list->settings;
  if (file->userInfo.empty() && file->origin() == list->origin())
  {
    file->userInfo = list->userInfo;
  }
  return file->textWithSettings() == named ? to : rememberAddress(*file);
}

RemoteOpener::Opened RemoteOpener::openNow(
  const std::string& name, const Address& address, const FirstBytes& first, Tables& tables) const
{
  const Result<FarSettings> settings = FarSettings::parse(address.settings);
  if (!settings)
  {
    return settings.error();
  }
  const Result<std::shared_ptr<const FarCache>> cache = FarCache::of(*settings);
  if (!cache)
  {
    return cache.error();
  }
  Result<Request> request = requestOf(address);
  if (!request)
  {
    return request.error();
  }
  RemoteOptions options = options_;
  if (settings->timeoutSeconds)
  {
    options.timeLimit = std::chrono::milliseconds(
      std::max(1L, static_cast<long>(1000.0 * *settings->timeoutSeconds)));
  }
  const Clock::time_point begin = Clock::now();
  const std::string server = request->address.origin();
  const Result<std::shared_ptr<const RemoteSource>> opened =
    RemoteSource::open(std::make_unique<const Conversation>(name, std::move(*request), options),
      first, { *cache, settings->offline.value_or(FarCache::offline()) });
  if (opened)
  {
    return std::shared_ptr<const ByteSource>(*opened);
  }
  if (opened.error().kind == Error::Kind::Unreadable &&
    !TransferLoop::ofProcess().answeredSince(server, begin))
  {
    const Clock::time_point now = Clock::now();
    const std::lock_guard<std::mutex> lock(tables.mutex);
    tables.silent[address.origin()] = { now + (now - begin) };
  }
  return opened.error();
}

/// An opening that others may wait for.
RemoteOpener::Opened RemoteOpener::openFor(const std::string& name, const Address& address,
  const FirstBytes& first, Tables& tables, std::promise<Opened>& promise) const
{
  std::optional<Opened> opened;
  std::exception_ptr failure;
  try
  {
    opened = openNow(name, address, first, tables);
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  {
    const std::lock_guard<std::mutex> lock(tables.mutex);
    tables.opening.erase(name);
    if (opened)
    {
      tables.note(name, *opened);
    }
  }
  if (failure)
  {
    promise.set_exception(failure);
    std::rethrow_exception(failure);
  }
  promise.set_value(*opened);
  return std::move(*opened);
}

Result<std::shared_ptr<const ByteSource>> RemoteOpener::open(
  const std::string& text, const FirstBytes& first) const
{
  const Result<Address> address = Address::parse(addressOf(text));
  if (!address)
  {
    return address.error();
  }
  if (options_.fault)
  {
    return *options_.fault;
  }
  const std::string name = rememberAddress(*address);
  if (isMark(address->query))
  {
    return makeError(Error::Kind::BadArgument,
      "'" + name +
        "' stands for an address with a user, a password or a query that this process "
        "does not know; open it by the whole address");
  }
  Tables& tables = tables_->get([] { return std::make_unique<Tables>(); });
  for (;;)
  {
    std::promise<Opened> promise;
    std::shared_future<Opened> other;
    {
      const std::lock_guard<std::mutex> lock(tables.mutex);
      if (std::optional<Opened> known = tables.find(name, address->origin(), isOffline(*address)))
      {
        return std::move(*known);
      }
      const auto found = tables.opening.find(name);
      if (found != tables.opening.end())
      {
        other = found->second;
      }
      else
      {
        tables.opening.emplace(name, promise.get_future().share());
      }
    }
    if (!other.valid())
    {
      return openFor(name, *address, first, tables, promise);
    }
    while (other.wait_for(lookAgain) != std::future_status::ready)
    {
      if (StopOfReads::asked())
      {
        return makeError(Error::Kind::Cancelled, "'" + name + "' is not wanted any more");
      }
    }
    if (const Opened& outcome = other.get();
        outcome || outcome.error().kind != Error::Kind::Cancelled)
    {
      return outcome;
    }
    // Another thread opened it, and was stopped: this one's turn.
  }
}

void addRemoteOpeners()
{
  const std::shared_ptr<const ByteOpener> opener = openerOfProcess();
  for (const char* scheme : { "http", "https", "s3" })
  {
    ByteOpeners::ofProcess().add(scheme, opener);
  }
}

} // namespace pointfront
