#include "pointfront/Disk/FarSettings.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Base/NumberText.h"
#include "pointfront/Base/PercentCode.h"
#include "pointfront/Disk/ByteOpeners.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr std::string_view begin = "#far:";
constexpr std::string_view keptInValues = "/._-~";
constexpr double longestSeconds = 1e6;

Error wrong(const std::string& what)
{
  return makeError(Error::Kind::BadArgument, what);
}

/// Takes "name=value" into the settings.
Result<void> take(const std::string& name, const std::string& value, FarSettings& settings)
{
  if (name == "offline" && (value == "0" || value == "1"))
  {
    settings.offline = value == "1";
  }
  else if (name == "cache")
  {
    settings.cacheFolder = value;
  }
  else if (name == "cache_size")
  {
    const Result<std::uint64_t> bytes = cacheBytesOf(value);
    if (!bytes)
    {
      return bytes.error();
    }
    settings.cacheBytes = *bytes;
  }
  else if (name == "timeout")
  {
    std::string_view rest(value);
    const double seconds = takeNumber(rest);
    settings.timeoutSeconds = rest.empty() && seconds == seconds ? seconds : -1.0;
  }
  else
  {
    return wrong("'" + name + "=" + value +
      "' is no setting of an address: offline=0 or 1, cache=FOLDER or off, cache_size=BYTES and "
      "timeout=SECONDS are, with '&' between them");
  }
  return {};
}
} // namespace

Result<void> FarSettings::check() const
{
  if (timeoutSeconds && !(*timeoutSeconds > 0.0 && *timeoutSeconds < longestSeconds))
  {
    return wrong("the time limit of an address is a number of seconds above 0 and below a million");
  }
  if (cacheFolder && cacheFolder->empty())
  {
    return wrong("the cache of an address is a folder, or \"off\"; its name is empty");
  }
  const bool without = (cacheFolder && *cacheFolder == "off") || (cacheBytes && *cacheBytes == 0);
  if (offline.value_or(false) && without)
  {
    return wrong("an address can be read offline from the cache only, and the cache is off for it");
  }
  return {};
}

Result<std::string> FarSettings::named(const std::string& address) const
{
  if (!any())
  {
    return address;
  }
  if (!isAddress(address))
  {
    return wrong("'" + address +
      "' is a path: offline, cache and time limit are for addresses (https://..., s3://...)");
  }
  if (Result<void> sound = check(); !sound)
  {
    return sound.error();
  }
  std::string text;
  const auto add = [&text](const char* name, const std::string& value)
  { text += (text.empty() ? "" : "&") + std::string(name) + "=" + value; };
  if (offline)
  {
    add("offline", *offline ? "1" : "0");
  }
  if (cacheFolder)
  {
    add("cache", percentEncoded(*cacheFolder, keptInValues));
  }
  if (cacheBytes)
  {
    add("cache_size", std::to_string(*cacheBytes));
  }
  if (timeoutSeconds)
  {
    add("timeout", numberText(*timeoutSeconds, 9));
  }
  const std::string plain = withoutFarSettings(address);
  const std::size_t fragment = std::min(plain.find('#'), plain.size()); // such as "#epoch=2024"
  return plain.substr(0, fragment) + std::string(begin) + text + plain.substr(fragment);
}

Result<FarSettings> FarSettings::parse(std::string_view text)
{
  FarSettings settings;
  while (!text.empty())
  {
    const std::string_view one = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(one.size() + 1, text.size()));
    const std::size_t equals = std::min(one.find('='), one.size());
    const std::string value =
      equals < one.size() ? percentDecoded(one.substr(equals + 1)) : std::string();
    if (Result<void> taken = take(std::string(one.substr(0, equals)), value, settings); !taken)
    {
      return taken.error();
    }
  }
  if (Result<void> sound = settings.check(); !sound)
  {
    return sound.error();
  }
  return settings;
}

Result<std::uint64_t> cacheBytesOf(const std::string& text)
{
  std::string_view rest(text);
  const double bytes = takeNumber(rest);
  const std::string unit = lowered(rest.substr(0, 1));
  const std::size_t power = unit.empty() ? 0 : std::string("?kmgt").find(unit, 1);
  const double all = bytes * double(std::uint64_t(1) << (10 * std::min<std::size_t>(power, 5)));
  if (power > 4 || rest.size() > 1 || !(all >= 0.0 && all < 9e18))
  {
    return wrong("'" + text + "' is no size of a cache: 512M, 4G; 0 for none");
  }
  return static_cast<std::uint64_t>(all);
}

bool hasFarSettings(std::string_view name)
{
  return name.find(begin) != std::string_view::npos;
}

std::string_view farSettingsTextOf(std::string_view address)
{
  const std::size_t at = address.find(begin);
  if (at == std::string_view::npos)
  {
    return {};
  }
  const std::string_view rest = address.substr(at + begin.size());
  return rest.substr(0, rest.find('#'));
}

std::string withoutFarSettings(const std::string& address)
{
  const std::size_t at = address.find(begin);
  if (at == std::string::npos)
  {
    return address;
  }
  const std::size_t size = begin.size() + farSettingsTextOf(address).size();
  return address.substr(0, at) + address.substr(at + size);
}

} // namespace pointfront
