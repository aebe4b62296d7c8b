#include "Address.h"

#include "Sha256.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/FarSettings.h"
#include "pointfront/Threads/ForkHold.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <random>
#include <string_view>
#include <vector>

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

/// The part of a signature that each part of a query is, if it is one for sure. Many a server has a
/// file's name in "key", "token" or "st", so those of Azure count only beside its `sig`, and those
/// of Amazon's older and Google's older signatures only together.
class SignedParts
{
public:
  explicit SignedParts(const std::vector<std::string>& names)
    : names_(names)
  {
    const bool signature = has("signature");
    azure_ = has("sig");
    cloudFront_ = signature && has("key-pair-id") && (has("policy") || has("expires"));
    store_ = signature && has("expires") &&
      (has("awsaccesskeyid") || has("googleaccessid") || has("ossaccesskeyid"));
  }
  bool isSignature(const std::string& name) const
  {
    return name.rfind("x-amz-", 0) == 0 || name.rfind("x-goog-", 0) == 0 ||
      (azure_ &&
        isOf(name,
          { "sig", "se", "sp", "sv", "sr", "st", "si", "spr", "sip", "skoid", "sktid", "skt", "ske",
            "sks", "skv", "sdd", "ss", "srt" })) ||
      (cloudFront_ && isOf(name, { "signature", "key-pair-id", "policy", "expires" })) ||
      (store_ &&
        isOf(
          name, { "signature", "expires", "awsaccesskeyid", "googleaccessid", "ossaccesskeyid" }));
  }

private:
  static bool isOf(const std::string& name, std::initializer_list<std::string_view> list)
  {
    return std::find(list.begin(), list.end(), name) != list.end();
  }
  bool has(std::string_view name) const
  {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
  }

  const std::vector<std::string>& names_; ///< in small letters
  bool azure_ = false;
  bool cloudFront_ = false;
  bool store_ = false;
};

/// The parts of a query, between '&'.
std::vector<std::string> partsOf(const std::string& query)
{
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < query.size();)
  {
    const std::size_t end = std::min(query.find('&', begin), query.size());
    parts.push_back(query.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// A child of fork() knows the addresses of its parent.
struct Remembered
{
  struct Secret
  {
    std::string userInfo;
    std::string query;
    std::string settings;
  };
  std::map<std::string, std::string> addresses; ///< by their public forms
  std::map<std::string, Secret> secrets; ///< by origin and mark: of what lies beside an address
};

Remembered& remembered(const ForkHold&)
{
  static auto* const table = new Remembered; // never deleted: static objects may use it
  return *table;
}

const std::string& saltOfProcess()
{
  const ForkHold hold;
  static auto* const salt = []
  {
    std::random_device chance;
    return new std::string(std::to_string(chance()) + ' ' + std::to_string(chance()) + ' ');
  }();
  return *salt;
}

/// Stands for the secrets of an address. It is another one in each process, so that nobody finds a
/// weak password by it.
std::string markOf(const Address& address)
{
  if (address.query.empty() && address.userInfo.empty() && address.settings.empty())
  {
    return {};
  }
  char hash[24];
  std::snprintf(hash, sizeof hash, "%016llx",
    static_cast<unsigned long long>(
      hashOf(saltOfProcess() + address.userInfo + '\n' + address.query + '\n' + address.settings)));
  return hashMark + std::string(hash);
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
  address.settings = farSettingsTextOf(text);
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

Result<Address> Address::redirected(const std::string& location) const
{
  if (location.empty())
  {
    return makeError(Error::Kind::BadArgument, "a redirection to nowhere");
  }
  std::string target;
  for (const char c : location)
  {
    target += c == ' ' ? "%20" : std::string(1, c);
  }
  const char first = target.front();
  const bool fromHost = target.compare(0, 2, "//") == 0;
  Result<Address> next = parse(isAddress(target) ? target
      : fromHost                                 ? scheme + ":" + target
      : first == '/'                             ? origin() + target
      : first == '?'                             ? origin() + path + target
                     : origin() + path.substr(0, path.rfind('/') + 1) + target);
  if (next)
  {
    next->settings.clear(); // those are the user's alone
    if (next->userInfo.empty() && next->origin() == origin())
    {
      next->userInfo = userInfo;
    }
  }
  return next;
}

std::string Address::text() const
{
  return scheme + "://" + (userInfo.empty() ? "" : userInfo + "@") + host + path +
    (query.empty() ? "" : "?" + query);
}

std::string Address::textWithSettings() const
{
  return text() + (settings.empty() ? "" : "#far:" + settings);
}

std::string Address::publicForm() const
{
  const std::string mark = markOf(*this);
  return scheme + "://" + host + path + (mark.empty() ? "" : "?" + mark);
}

std::string Address::place() const
{
  const std::vector<std::string> parts = partsOf(query);
  std::vector<std::string> names;
  for (const std::string& part : parts)
  {
    names.push_back(lowered(part.substr(0, part.find('='))));
  }
  const SignedParts signedParts(names);
  std::string others;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    others += signedParts.isSignature(names[i]) ? "" : parts[i] + '&';
  }
  const std::string text = scheme + "://" + host + path;
  return others.empty() ? text : text + '?' + hashMark + sha256(others);
}

std::string rememberAddress(const Address& address)
{
  const std::string form = address.publicForm();
  if (address.query.compare(0, 1, hashMark) == 0)
  {
    // A public form that this process does not know.
    return address.scheme + "://" + address.host + address.path + '?' + address.query;
  }
  const std::string mark = markOf(address);
  const ForkHold hold;
  Remembered& table = remembered(hold);
  table.addresses[form] = address.textWithSettings();
  if (!mark.empty())
  {
    table.secrets[address.origin() + ' ' + mark] = { address.userInfo, address.query,
      address.settings };
  }
  return form;
}

void rememberAddress(const Address& address, const std::string& mark)
{
  const ForkHold hold;
  remembered(hold).secrets[address.origin() + ' ' + mark] = { address.userInfo, address.query,
    address.settings };
}

bool isMark(std::string_view text)
{
  return text.size() == 17 && text.substr(0, 1) == hashMark &&
    text.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos;
}

std::string addressOf(const std::string& text)
{
  const ForkHold hold;
  const Remembered& table = remembered(hold);
  const auto found = table.addresses.find(text);
  if (found != table.addresses.end())
  {
    return found->second;
  }
  Result<Address> address = Address::parse(text);
  const auto secret =
    address ? table.secrets.find(address->origin() + ' ' + address->query) : table.secrets.end();
  if (secret == table.secrets.end())
  {
    return text;
  }
  address->userInfo = secret->second.userInfo;
  address->query = secret->second.query;
  address->settings = address->settings.empty() ? secret->second.settings : address->settings;
  return address->textWithSettings();
}

} // namespace pointfront
