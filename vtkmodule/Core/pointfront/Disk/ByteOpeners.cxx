#include "pointfront/Disk/ByteOpeners.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Threads/ForkHold.h"

#include <algorithm>
#include <utility>

namespace pointfront
{

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

std::string beside(const std::string& path, const std::string& name)
{
  if (isAddress(name) && isAddress(path))
  {
    const std::shared_ptr<const ByteOpener> opener = ByteOpeners::ofProcess().find(schemeOf(path));
    return opener ? opener->passedOn(path, name) : name;
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
  const std::size_t query = std::min(path.find('?'), path.find('#'));
  const std::string place = path.substr(0, query);
  const std::size_t host = place.find("://") + 3;
  const std::size_t slash = place.rfind('/');
  const std::string folder =
    slash == std::string::npos || slash < host ? place + '/' : place.substr(0, slash + 1);
  return folder + name + (query == std::string::npos ? std::string() : path.substr(query));
}

} // namespace pointfront
