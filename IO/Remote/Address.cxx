#include "Address.h"

#include "pointfront/Disk/ByteOpeners.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>

namespace pointfront
{
namespace
{
constexpr const char* hashMark = "~"; ///< before the hash of a query; no query begins with it

/// FNV-1a. It tells queries from each other; nobody finds a key by its 64 bits.
std::uint64_t hashOf(const std::string& text)
{
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text)
  {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  }
  return hash;
}

struct Remembered
{
  std::mutex mutex;
  std::map<std::string, std::string> addresses; ///< by their public forms
};

Remembered& remembered()
{
  static auto* const table = new Remembered; // never deleted: static objects may use it
  return *table;
}
} // namespace

Result<Address> Address::parse(std::string_view text)
{
  Address address;
  address.scheme = schemeOf(text);
  if (address.scheme.empty() ||
    std::any_of(text.begin(), text.end(),
      [](char c) { return static_cast<unsigned char>(c) <= 0x20 || c == 0x7f; }))
  {
    return makeError(Error::Kind::BadArgument,
      "not an address: scheme://host/path without spaces (write %20) is expected");
  }
  text.remove_prefix(address.scheme.size() + 3);
  text = text.substr(0, text.find('#'));
  const std::size_t query = text.find('?');
  if (query != std::string_view::npos)
  {
    address.query = text.substr(query + 1);
    text = text.substr(0, query);
  }
  const std::size_t slash = text.find('/');
  address.path = slash == std::string_view::npos ? "/" : std::string(text.substr(slash));
  std::string_view place = text.substr(0, slash);
  const std::size_t user = place.rfind('@');
  if (user != std::string_view::npos)
  {
    address.userInfo = place.substr(0, user);
    place.remove_prefix(user + 1);
  }
  address.host = place;
  std::transform(address.host.begin(), address.host.end(), address.host.begin(),
    [](unsigned char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : char(c); });
  if (address.host.empty())
  {
    return makeError(Error::Kind::BadArgument, "an address without a host: scheme://host/path");
  }
  return address;
}

std::string Address::text() const
{
  return scheme + "://" + (userInfo.empty() ? "" : userInfo + "@") + host + path +
    (query.empty() ? "" : "?" + query);
}

std::string Address::publicForm() const
{
  std::string form = scheme + "://" + host + path;
  if (!query.empty())
  {
    char hash[24];
    std::snprintf(hash, sizeof hash, "%08x", static_cast<unsigned>(hashOf(query)));
    form += std::string("?") + hashMark + hash;
  }
  return form;
}

std::string rememberAddress(const Address& address)
{
  const std::string form = address.publicForm();
  if (address.query.compare(0, 1, hashMark) == 0)
  {
    return address.text(); // a public form that this process does not know
  }
  Remembered& table = remembered();
  const std::lock_guard<std::mutex> lock(table.mutex);
  table.addresses[form] = address.text();
  return form;
}

std::string addressOf(const std::string& text)
{
  Remembered& table = remembered();
  const std::lock_guard<std::mutex> lock(table.mutex);
  const auto found = table.addresses.find(text);
  return found != table.addresses.end() ? found->second : text;
}

} // namespace pointfront
