#include "RemoteOptions.h"

#include "Credentials.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Disk/SmallFile.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t mostSettingsBytes = std::uint64_t(1) << 20;

std::string setting(const char* name)
{
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::string firstOf(std::initializer_list<const char*> names)
{
  for (const char* name : names)
  {
    if (std::string value = setting(name); !value.empty())
    {
      return value;
    }
  }
  return {};
}

std::string trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  const std::size_t last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

/// The name of "[name]", of a server as Address::origin() says it. Empty: it names no whole server.
std::string sectionName(const std::string& line, bool server)
{
  const std::string name = line.substr(1, line.find(']') - 1);
  const Result<Address> address = server ? Address::parse(name) : makeError(Error::Kind(), "");
  const bool whole = address && address->path.find_first_not_of('/') == std::string::npos &&
    address->query.empty() && address->userInfo.empty();
  return !server ? name : (whole ? address->origin() : std::string());
}

Error badLine(const std::string& path, std::size_t number, const std::string& what)
{
  return makeError(
    Error::Kind::BadArgument, "line " + std::to_string(number) + " of '" + path + "' " + what);
}

/// The lines of one "[section]" of a file.
/// servers  sections name servers; lines above the first one are an error, else nobody reads them
Result<std::vector<std::string>> sectionOf(
  const std::string& path, const std::string& section, bool servers)
{
  const Result<std::string> text = readSmallText(path, mostSettingsBytes);
  if (!text)
  {
    return text.error();
  }
  std::vector<std::string> lines;
  bool inside = false;
  bool above = true;
  std::size_t number = 0;
  std::istringstream in(*text);
  for (std::string line; std::getline(in, line);)
  {
    ++number;
    line = trimmed(line);
    if (line.empty() || line.front() == '#' || line.front() == ';')
    {
      continue;
    }
    if (line.front() == '[')
    {
      const std::string name = sectionName(line, servers);
      if (name.empty() && servers)
      {
        return badLine(path, number,
          "names no server: headers are for a whole server; write [" + section + "] for that one");
      }
      inside = name == section;
      above = false;
    }
    else if (servers && above)
    {
      return badLine(path, number,
        "has nothing in brackets above it that says whom it is for; write [" + section + "] there");
    }
    else if (inside)
    {
      lines.push_back(line);
    }
  }
  return lines;
}

/// "name = value" lines as a map.
std::map<std::string, std::string> valuesOf(const std::vector<std::string>& lines)
{
  std::map<std::string, std::string> values;
  for (const std::string& line : lines)
  {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos)
    {
      values[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
    }
  }
  return values;
}

/// Keys of an object store, and where it is.
struct StoreAccess
{
  std::string endpoint;
  std::string region;
  std::string key;
  std::string secret;
  std::string token;
};

Result<StoreAccess> storeAccess()
{
  StoreAccess access;
  access.endpoint = firstOf({ "AWS_ENDPOINT_URL_S3", "AWS_ENDPOINT_URL" });
  access.region = firstOf({ "AWS_REGION", "AWS_DEFAULT_REGION" });
  access.key = setting("AWS_ACCESS_KEY_ID");
  access.secret = setting("AWS_SECRET_ACCESS_KEY");
  access.token = setting("AWS_SESSION_TOKEN");
  const std::string home = setting("HOME");
  const std::string named = setting("AWS_PROFILE");
  const std::string profile = named.empty() ? "default" : named;
  const auto read = [&](const std::string& file, const std::string& section,
                      bool must) -> Result<std::map<std::string, std::string>>
  {
    const Result<std::vector<std::string>> lines = sectionOf(file, section, false);
    if (!lines)
    {
      return must ? Result<std::map<std::string, std::string>>(lines.error())
                  : std::map<std::string, std::string>();
    }
    return valuesOf(*lines);
  };
  if (access.key.empty())
  {
    const std::string file = setting("AWS_SHARED_CREDENTIALS_FILE");
    const auto keys =
      read(file.empty() ? home + "/.aws/credentials" : file, profile, !file.empty());
    if (!keys)
    {
      return keys.error();
    }
    const auto value = [&](const char* name)
    {
      const auto found = keys->find(name);
      return found != keys->end() ? found->second : std::string();
    };
    access.key = value("aws_access_key_id");
    access.secret = value("aws_secret_access_key");
    access.token = value("aws_session_token");
    access.region = access.region.empty() ? value("region") : access.region;
  }
  if (access.region.empty())
  {
    const std::string file = setting("AWS_CONFIG_FILE");
    const auto values = read(file.empty() ? home + "/.aws/config" : file,
      profile == "default" ? profile : "profile " + profile, false);
    const auto found = values->find("region");
    access.region = found != values->end() ? found->second : "us-east-1";
  }
  // The words of `pointfront cluster build`.
  std::string anonymous = setting("AWS_NO_SIGN_REQUEST");
  std::transform(anonymous.begin(), anonymous.end(), anonymous.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (anonymous == "yes" || anonymous == "true" || anonymous == "1")
  {
    access.key.clear();
  }
  return access;
}

Result<Request> storeRequest(const Address& address)
{
  const Result<StoreAccess> access = storeAccess();
  if (!access)
  {
    return access.error();
  }
  const std::string& bucket = address.host;
  std::string url;
  if (!access->endpoint.empty())
  {
    std::string endpoint = access->endpoint;
    endpoint.erase(endpoint.find_last_not_of('/') + 1);
    url = endpoint + "/" + bucket + address.path;
  }
  else if (bucket.find('.') != std::string::npos) // no certificate covers such a host
  {
    url = "https://s3." + access->region + ".amazonaws.com/" + bucket + address.path;
  }
  else
  {
    url = "https://" + bucket + ".s3." + access->region + ".amazonaws.com" + address.path;
  }
  const Result<Address> place = Address::parse(url);
  if (!place || (place->scheme != "http" && place->scheme != "https"))
  {
    return makeError(
      Error::Kind::BadArgument, "AWS_ENDPOINT_URL is no address of a server; write https://host");
  }
  Request request;
  request.address = *place;
  request.address.query = address.query;
  if (!access->key.empty())
  {
    request.signature = Signature{ access->region, access->key, access->secret };
    request.headers.push_back("x-amz-content-sha256: UNSIGNED-PAYLOAD");
    if (!access->token.empty())
    {
      request.headers.push_back("x-amz-security-token: " + access->token);
    }
  }
  if (const std::string payer = setting("AWS_REQUEST_PAYER"); !payer.empty())
  {
    request.headers.push_back("x-amz-request-payer: " + payer);
  }
  return request;
}
} // namespace

RemoteOptions RemoteOptions::ofEnvironment()
{
  RemoteOptions options;
  if (const std::string text = setting("POINTFRONT_REMOTE_TIMEOUT"); !text.empty())
  {
    std::string_view rest(text);
    const double seconds = takeNumber(rest);
    if (rest.empty() && seconds >= 0.001 && seconds < 1e6)
    {
      options.timeLimit = std::chrono::milliseconds(static_cast<long>(1000.0 * seconds));
    }
    else
    {
      options.fault = makeError(Error::Kind::BadArgument,
        "POINTFRONT_REMOTE_TIMEOUT is '" + text + "'; write seconds from 0.001 to a million");
    }
  }
  // A misspelt refusal that is passed over would reach servers that it is set to keep away from.
  const std::string ofPrivate = setting("POINTFRONT_REMOTE_PRIVATE");
  options.refusePrivate = ofPrivate == "refuse";
  if (!ofPrivate.empty() && !options.refusePrivate && ofPrivate != "allow")
  {
    options.fault = makeError(Error::Kind::BadArgument,
      "POINTFRONT_REMOTE_PRIVATE is '" + ofPrivate + "'; write refuse or allow");
  }
  if (const Result<void> learnt = learnCredentialsOfEnvironment(); !learnt)
  {
    options.fault = learnt.error();
  }
  return options;
}

Result<Request> requestOf(const Address& address)
{
  if (address.scheme == "s3")
  {
    return storeRequest(address);
  }
  Request request;
  request.address = address;
  request.headers = headersFor(address.origin());
  const std::string file = setting("POINTFRONT_HTTP_HEADERS");
  if (request.headers.empty() && !file.empty())
  {
    Result<std::vector<std::string>> lines = sectionOf(file, address.origin(), true);
    if (!lines)
    {
      return makeError(lines.error().kind, "POINTFRONT_HTTP_HEADERS: " + lines.error().what);
    }
    request.headers = std::move(*lines);
  }
  return request;
}

} // namespace pointfront
