#pragma once

#include "Address.h"
#include "HttpTransfer.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// How a process reads from servers.
struct RemoteOptions
{
  std::chrono::milliseconds timeLimit{ 60000 }; ///< for a read while (nearly) no bytes come
  unsigned retries = 12; ///< retries of a request
  std::chrono::milliseconds firstPause{ 100 }; ///< before a retry; it doubles, and is jittered
  unsigned redirects = 8;
  /// Refuse servers on this machine and in its network: for services that open what users name.
  bool refusePrivate = false;
  /// Servers that know no ranges are read whole up to this size.
  std::uint64_t wholeAtMost = std::uint64_t(64) << 20;

  std::optional<Error> fault; ///< a fault of the environment: the error of each opening

  /// The defaults, with what the environment says: POINTFRONT_REMOTE_TIMEOUT (seconds),
  /// POINTFRONT_REMOTE_PRIVATE=refuse|allow, and POINTFRONT_FAR (Credentials.h).
  static RemoteOptions ofEnvironment();
};

/// How an address is asked for: with which further headers, and how it is signed.
struct Request
{
  Address address; ///< http or https
  std::vector<std::string> headers; ///< secret; for address.origin() alone
  std::optional<Signature> signature; ///< for address.origin() alone
};

/// The request of an address of any scheme.
/// http, https  user and password of the address; headers of Credentials.h, or else the lines
/// "Name: value" of the file that
///              POINTFRONT_HTTP_HEADERS names, below a line "[https://host]" each, for that origin.
/// s3           "s3://bucket/key", with region, endpoint and keys of the environment (AWS_REGION,
///              AWS_ENDPOINT_URL, AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, AWS_SESSION_TOKEN,
///              AWS_REQUEST_PAYER) or of the profile AWS_PROFILE in the credentials file. Without
///              keys, or with AWS_NO_SIGN_REQUEST, the request is anonymous.
/// Errors       BadArgument; Unreadable: a file of headers or keys that is named and cannot be
/// read.
Result<Request> requestOf(const Address& address);

} // namespace pointfront
