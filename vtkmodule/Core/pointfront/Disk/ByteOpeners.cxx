#include "pointfront/Disk/ByteOpeners.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Base/PercentCode.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Disk/FarSettings.h"
#include "pointfront/Threads/ForkHold.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
/// Characters that a path in an address may have as they are (RFC 3986, section 3.3), but '+',
/// which object stores take for a blank.
constexpr std::string_view keptInPaths = "/-._~!$&'()*,;=:@";
} // namespace

ByteOpeners& ByteOpeners::ofProcess()
{
  const ForkHold hold;
  static auto* const openers = new ByteOpeners; // never deleted: static objects may use it
  return *openers;
}

void ByteOpeners::add(const std::string& scheme, std::shared_ptr<const ByteOpener> opener)
{
  const ForkHold hold;
  openers_[scheme].swap(opener); // an earlier one goes when the hold is over
}

std::shared_ptr<const ByteOpener> ByteOpeners::find(const std::string& scheme) const
{
  const ForkHold hold;
  const auto found = openers_.find(scheme);
  return found != openers_.end() ? found->second : nullptr;
}

std::string ByteOpeners::schemesInWords() const
{
  const ForkHold hold;
  if (openers_.empty())
  {
    return "it opens files only; download the file and name its path";
  }
  std::string text = "it opens ";
  std::size_t number = 0;
  for (const auto& [scheme, opener] : openers_)
  {
    text += number == 0 ? "" : number + 1 == openers_.size() ? " and " : ", ";
    text += scheme;
    ++number;
  }
  return text + ", and files";
}

std::string schemeOf(std::string_view path)
{
  const std::size_t end = path.find("://");
  if (end == std::string_view::npos || end == 0)
  {
    return {};
  }
  const std::string_view scheme = path.substr(0, end);
  const bool sound = isAsciiLetter(scheme.front()) &&
    std::all_of(scheme.begin(), scheme.end(),
      [](char c) { return isAsciiLetterOrDigit(c) || c == '+' || c == '-' || c == '.'; });
  if (!sound)
  {
    return {};
  }
  return lowered(scheme);
}

std::string publicForm(const std::string& path)
{
  const std::string scheme = schemeOf(path);
  const std::shared_ptr<const ByteOpener> opener =
    scheme.empty() ? nullptr : ByteOpeners::ofProcess().find(scheme);
  if (!opener)
  {
    return path;
  }
  EpochAddress named = EpochAddress::of(path);
  named.file = opener->publicForm(named.file);
  return named.text();
}

std::string fileNameOf(std::string_view path)
{
  if (isAddress(path))
  {
    path = path.substr(0, path.find_first_of("?#"));
  }
  return std::string(path.substr(path.rfind('/') + 1)); // all of it without one
}

std::string withoutDots(const std::string& address)
{
  const std::size_t query = std::min(address.find_first_of("?#"), address.size());
  const std::size_t root = std::min(address.find('/', address.find("://") + 3), query);
  std::vector<std::string> parts;
  for (std::size_t begin = root; begin < query;)
  {
    const std::size_t end = std::min(address.find('/', begin + 1), query);
    const std::string part = address.substr(begin + 1, end - begin - 1);
    if (part == ".." && !parts.empty())
    {
      parts.pop_back();
    }
    else if (part != "." && part != "..")
    {
      parts.push_back(part);
    }
    begin = end;
  }
  std::string path;
  for (const std::string& part : parts)
  {
    path += '/' + part;
  }
  return address.substr(0, root) + path + address.substr(query);
}

std::string beside(const std::string& path, const std::string& name)
{
  if (isAddress(name) && isAddress(path))
  {
    const std::shared_ptr<const ByteOpener> opener = ByteOpeners::ofProcess().find(schemeOf(path));
    EpochAddress named = EpochAddress::of(name);
    named.file = opener ? opener->passedOn(path, named.file) : named.file;
    return named.text();
  }
  if (isAddress(name) || (!name.empty() && name.front() == '/'))
  {
    return name;
  }
  if (!isAddress(path))
  {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? name : path.substr(0, slash + 1) + name;
  }
  const std::size_t query = std::min(path.find_first_of("?#"), path.size());
  const std::string place = path.substr(0, query);
  const std::size_t host = place.find("://") + 3;
  const std::size_t slash = place.rfind('/');
  const std::string folder =
    slash == std::string::npos || slash < host ? place + '/' : place.substr(0, slash + 1);
  EpochAddress named = EpochAddress::of(folder + name);
  if (named.epoch && named.epoch->find('#') != std::string::npos) // no epoch, perhaps settings
  {
    named = { folder + name, std::nullopt };
  }
  named.file = withoutDots(folder + percentEncoded(named.file.substr(folder.size()), keptInPaths)) +
    path.substr(query);
  return named.text();
}

Result<void> refuseSettings(const std::string& list, const std::string& name)
{
  if (!hasFarSettings(name) || !(isAddress(list) || isAddress(name)))
  {
    return {};
  }
  const std::string plain = publicForm(name.substr(0, name.find_first_of("?#"))); // no secrets
  return makeError(Error::Kind::Unsupported,
    list + ": names '" + plain +
      "' with settings of its own ('#far:'); only the address that a user gives, or a line of a "
      "list of stores on this machine, may have them");
}

Result<std::string> fileNamedBy(const std::string& list, const std::string& name)
{
  if (isAddress(list))
  {
    if (Result<void> sound = refuseSettings(list, name); !sound)
    {
      return sound.error();
    }
    if (schemeOf(name) == "file" || (!name.empty() && name.front() == '/'))
    {
      const std::size_t path = name.front() == '/' ? 0 : name.find("://") + 3;
      return makeError(Error::Kind::Unsupported,
        list + ": names the file '" + name.substr(path) +
          "' of the machine that reads it; a list behind an address names addresses, and paths "
          "relative to its own");
    }
  }
  return beside(list, name);
}

} // namespace pointfront
