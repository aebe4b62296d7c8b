#pragma once

#include "pointfront/Disk/ByteSource.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace pointfront
{

/// Opens addresses of one scheme ("https") or several.
class ByteOpener
{
public:
  virtual ~ByteOpener() = default;
  /// The public form of an address: without what is secret in it. This process opens it as it opens
  /// the address.
  virtual std::string publicForm(const std::string& address) const { return address; }
  /// The name under which `to` is opened, an address that the file `from` names: it is read as
  /// `from` is, whatever settings stand in it.
  virtual std::string passedOn(
    [[maybe_unused]] const std::string& from, const std::string& to) const
  {
    return to;
  }
  /// By the address as the user wrote it, or its public form. A source that somebody holds open is
  /// the same for all who open its address.
  /// Errors  those of ByteSource.
  virtual Result<std::shared_ptr<const ByteSource>> open(
    const std::string& address, const FirstBytes& first) const = 0;
};

/// The schemes of addresses that this process opens. The kernel knows none: programs and plugins
/// add them at their start.
/// Threads  all functions from any thread; a child of fork() has those of its parent.
class ByteOpeners
{
public:
  static ByteOpeners& ofProcess();

  /// Later openers of a scheme replace earlier ones. `scheme` in small letters, without "://".
  void add(const std::string& scheme, std::shared_ptr<const ByteOpener> opener);
  /// Null if there is none.
  std::shared_ptr<const ByteOpener> find(const std::string& scheme) const;
  /// For a message: "it opens http, https and s3", or that it opens files only.
  std::string schemesInWords() const;

private:
  std::map<std::string, std::shared_ptr<const ByteOpener>> openers_; ///< guarded by ForkHold
};

/// The scheme of an address, in small letters: letters, digits, '+', '-' and '.' before "://".
/// Empty for a path.
std::string schemeOf(std::string_view path);
inline bool isAddress(std::string_view path)
{
  return !schemeOf(path).empty();
}

/// A path as it is; the public form of an address, under which this process knows it from now on.
/// Whoever takes names from users passes them on in this form: no secret then reaches a message, a
/// file or a picture.
std::string publicForm(const std::string& path);

/// The last part of a path or an address, without what an address asks for ("?...").
std::string fileNameOf(std::string_view path);

/// An address without "." and ".." among its folders.
std::string withoutDots(const std::string& address);

/// The address or path of what lies beside `path`, or below its folder: "a/b/ept.json" and
/// "ept-data/0-0-0-0.laz" give "a/b/ept-data/0-0-0-0.laz". `name` may be an address itself, or an
/// absolute path: it is the answer then. Beside an address, a path is percent-encoded, but for the
/// epoch of a collection behind it, and what is found has the query and the settings (FarSettings)
/// of that address. Names that a file has from strangers go through fileNamedBy().
std::string beside(const std::string& path, const std::string& name);

/// The path or address of a file that a list names by a path or an address (beside()): a line of a
/// list of stores, a tile of a collection. Where the list lies behind an address, its names are the
/// word of whoever serves it, and not of the user: they lead to no file of this machine, and choose
/// nothing of how this machine reads (FarSettings).
/// Errors  Unsupported: the list lies behind an address, and the name is that of a file of this
///         machine, or has settings.
Result<std::string> fileNamedBy(const std::string& list, const std::string& name);

/// Nobody writes settings into files of a kind that programs make. Whoever passes on such a file
/// could choose a cache on the machine of those who open it, wherever it lies.
/// Errors  Unsupported: an address with settings, or any name with them behind an address.
Result<void> refuseSettings(const std::string& list, const std::string& name);

} // namespace pointfront
