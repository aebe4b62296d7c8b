#pragma once

#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <shared_mutex>
#include <string>
#include <vector>

namespace pointfront
{

/// The kinds of stored clouds that this process opens: our stores, and what was added. IO modules
/// do not know each other, and who draws knows none of them: programs and plugins put them
/// together here, once, at their start.
/// Threads   all functions are safe from any thread.
class StoredCloudFormats
{
public:
  /// The one of this process. It knows our stores, and lists and folders of stored clouds, from
  /// the beginning.
  static StoredCloudFormats& ofProcess();

  StoredCloudFormats();
  StoredCloudFormats(const StoredCloudFormats&) = delete;
  StoredCloudFormats& operator=(const StoredCloudFormats&) = delete;

  /// Adds a kind; one of the same name is replaced, so that adding twice is adding once.
  void add(std::shared_ptr<const StoredCloudFormat> format);

  /// True if some kind takes the file by its content. Cheap, silent.
  bool accepts(const std::string& path) const;
  /// Opens with the kind that accepts the file's content. If none does, our store's reader says
  /// why it is not a store. What lies behind an address is opened once for all who look at it.
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const;
  /// The same, as a part of a larger cloud (StoredCloudFormat::openWhole).
  Result<std::shared_ptr<const StoredCloud>> openWhole(const std::string& path) const;

  /// Opens what an address names, with the first bytes that most kinds need: as long as somebody
  /// holds it, accepts() and open() ask for none of them again.
  static Result<std::shared_ptr<const ByteSource>> openFar(const std::string& address);

private:
  using Open = Result<std::shared_ptr<const StoredCloud>> (StoredCloudFormat::*)(
    const std::string&) const;
  Result<std::shared_ptr<const StoredCloud>> openBy(Open way, const std::string& path) const;
  std::shared_ptr<const StoredCloudFormat> formatOf(const std::string& path) const;

  mutable std::shared_mutex mutex_;
  std::vector<std::shared_ptr<const StoredCloudFormat>> formats_; ///< our own first
};

} // namespace pointfront
