#pragma once

#include "pointfront/Base/Result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pointfront
{

/// How one cloud behind an address is read, where that differs from what the process does by its
/// environment. The settings travel as a part of the name under which the cloud is opened,
/// "https://host/a.pfront#far:offline=1&timeout=5": whatever opens a cloud by its name opens it
/// with them, and the same address with other settings is another cloud. Files that the cloud names
/// (nodes of an EPT, tiles of a list) are read with its settings, and may not choose others
/// (fileNamedBy()). Secrets  a folder's name is none;
/// the public form of such an address has a mark all the same.
struct FarSettings
{
  std::optional<bool> offline; ///< no server is asked: what the cache has, or an error
  std::optional<std::string> cacheFolder; ///< "off": nothing is kept or taken from the disk
  std::optional<std::uint64_t> cacheBytes; ///< most bytes in the folder; 0: as "off"
  std::optional<double> timeoutSeconds; ///< time limit of a read while (nearly) nothing comes

  bool any() const { return offline || cacheFolder || cacheBytes || timeoutSeconds; }
  /// The name of the cloud at an address with these settings, in place of those that it has.
  /// Without any it is the address.
  /// Errors  BadArgument: a path, and no address; and those of check().
  Result<std::string> named(const std::string& address) const;
  /// Errors  BadArgument: a time that is not above 0, a folder without a name, offline without a
  ///         cache.
  Result<void> check() const;
  /// The settings as a name has them behind "#far:", which is no part of `text`.
  /// Errors  BadArgument: an unknown name, a value that is none; those of check().
  static Result<FarSettings> parse(std::string_view text);
};

/// The bytes of a cache whose size is "512M", "4G" or a number.
/// Errors  BadArgument: a text that is none.
Result<std::uint64_t> cacheBytesOf(const std::string& text);

/// Whether a name has "#far:" in it.
bool hasFarSettings(std::string_view name);
/// The text behind "#far:" in the name of a cloud, up to the next '#'; empty: it has none.
std::string_view farSettingsTextOf(std::string_view address);
/// The name without it.
std::string withoutFarSettings(const std::string& address);

} // namespace pointfront
