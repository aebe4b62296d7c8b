#pragma once

#include "pointfront/Base/Result.h"

#include <string>
#include <string_view>

namespace pointfront
{

/// The parts of an address: "https://user:password@host:port/path?query".
struct Address
{
  std::string scheme; ///< in small letters
  std::string userInfo; ///< secret
  std::string host; ///< with the port, if one is named
  std::string path; ///< begins with '/', as it was written
  std::string query; ///< without '?'; may be secret (signed addresses)
  std::string settings; ///< FarSettings of its reading, as they write them; no server sees them

  /// Errors  BadArgument, without the address's secret parts: no host, control characters.
  static Result<Address> parse(std::string_view text);

  /// The address that a redirection from this one names ("Location: ../b"). User and password go
  /// on to the same origin, and to no other. Errors  BadArgument, an empty name among them.
  Result<Address> redirected(const std::string& location) const;
  /// All of it, for the request. The fragment ("#...") of what was parsed is gone.
  std::string text() const;
  /// The same with the settings, as parse() takes it.
  std::string textWithSettings() const;
  /// Without what may be secret: instead of user, password, query and settings it has a short mark
  /// ("?~..."),
  /// so that addresses that differ in them stay different. The mark is another one in each process.
  /// For messages, and as the name of the cloud in this process.
  std::string publicForm() const;
  /// Requests to the same origin may carry the same secrets.
  std::string origin() const { return scheme + "://" + host; }
  /// Where the bytes are, whoever asks for them: without user, password, and what of the query is a
  /// signature for sure. What else is in the query ("?version=2", "?key=a.pfront") may choose the
  /// file, and may be secret: its SHA-256 stands for it.
  std::string place() const;
};

/// Notes an address, so that addressOf() finds it by its public form. Returns the latter.
std::string rememberAddress(const Address& address);
/// As rememberAddress(), with the mark that another process has made for it.
void rememberAddress(const Address& address, const std::string& mark);
/// Whether it is a mark as public forms have, such as "~1f3a9c2e44d07b61".
bool isMark(std::string_view text);
/// The full address behind a public form that this process has remembered, or the text itself. What
/// lies beside a remembered address, with the same mark, has the same user, password and query.
std::string addressOf(const std::string& text);

} // namespace pointfront
