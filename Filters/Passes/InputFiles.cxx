#include "InputFiles.h"

#include "pointfront/Base/FileNames.h"
#include "pointfront/Base/LetterCase.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/Epoch.h"

#include <algorithm>
#include <filesystem>
#include <glob.h>
#include <map>
#include <optional>

namespace pointfront
{

namespace
{
namespace fs = std::filesystem;

bool hasExtension(const fs::path& path, const std::vector<std::string>& extensions)
{
  const std::string extension = loweredExtension(path.string());
  return !extension.empty() &&
    std::find(extensions.begin(), extensions.end(), extension.substr(1)) != extensions.end();
}

/// Which files of a folder are meant when it is named.
struct FolderRule
{
  const std::vector<std::string>& extensions;
  const PointFileTest& isPointFile;
  const PointFileTest& isStore;
  std::vector<std::string>& warnings;

  bool takes(const fs::path& path) const
  {
    return hasExtension(path, extensions) && (!isPointFile || isPointFile(path.string()));
  }
  /// For people: ".las, .laz ...".
  std::string endings() const
  {
    std::string text;
    for (auto extension = extensions.begin(); extension != extensions.end(); ++extension)
    {
      const bool said = std::find(extensions.begin(), extension, *extension) != extension;
      text += said ? "" : (text.empty() ? "." : ", .") + *extension;
    }
    return text;
  }
  /// Point files alone where a folder has both.
  void leaveOutStores(const std::string& folder, std::vector<std::string>& files) const
  {
    if (!isStore)
    {
      return;
    }
    const auto stores = std::stable_partition(
      files.begin(), files.end(), [this](const std::string& file) { return !isStore(file); });
    if (stores == files.begin() || stores == files.end())
    {
      return;
    }
    warnings.push_back(folder + ": " + std::to_string(files.end() - stores) +
      " stores or indices in it are not read, because they may hold the points of the other files "
      "in it; name them to read them");
    files.erase(stores, files.end());
  }
};

Result<std::vector<std::string>> filesBelow(const std::string& folder, const FolderRule& rule)
{
  std::vector<std::string> files;
  std::error_code failure;
  if (const fs::path tree = fs::path(folder) / "ept.json";
      fs::is_regular_file(tree, failure) && rule.isPointFile)
  {
    return std::vector<std::string>{ tree.string() }; // not the files of its nodes one by one
  }
  fs::recursive_directory_iterator entry(folder, failure);
  for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure))
  {
    std::error_code vanished;
    if (entry->is_regular_file(vanished) && rule.takes(entry->path()))
    {
      files.push_back(entry->path().string());
    }
  }
  if (failure)
  {
    return makeError(
      Error::Kind::Unreadable, folder + ": cannot list the folder: " + failure.message());
  }
  if (files.empty())
  {
    return makeError(Error::Kind::NotFound,
      folder +
        ": the folder and those below it hold no point file; names were looked for that end in " +
        rule.endings());
  }
  rule.leaveOutStores(folder, files);
  return files;
}

Result<std::vector<std::string>> filesMatching(const std::string& pattern, const FolderRule& rule)
{
  glob_t matches = {};
  const int status = ::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &matches);
  std::vector<std::string> found;
  if (status == 0)
  {
    found.assign(matches.gl_pathv, matches.gl_pathv + matches.gl_pathc);
  }
  ::globfree(&matches);
  if (status == GLOB_NOMATCH)
  {
    return makeError(Error::Kind::NotFound, pattern + ": no file matches the pattern");
  }
  if (status != 0)
  {
    return makeError(Error::Kind::Unreadable, pattern + ": cannot list what matches the pattern");
  }
  std::vector<std::string> files;
  for (const std::string& path : found)
  {
    if (!fs::is_directory(path))
    {
      files.push_back(path);
      continue;
    }
    Result<std::vector<std::string>> inside = filesBelow(path, rule);
    if (!inside)
    {
      return inside.error();
    }
    files.insert(files.end(), inside->begin(), inside->end());
  }
  return files;
}

/// Whether a path is that of a file with the name of an epoch behind it.
bool isCollectionAtEpoch(const std::string& argument)
{
  std::error_code failure;
  const EpochAddress asked = EpochAddress::of(argument);
  return asked.epoch && fs::is_regular_file(asked.file, failure);
}

Result<std::vector<std::string>> expand(const std::string& argument, const FolderRule& rule)
{
  if (isAddress(argument))
  {
    return std::vector<std::string>{ argument }; // servers list nothing
  }
  std::error_code failure;
  const fs::file_status status = fs::status(argument, failure);
  if (fs::is_directory(status))
  {
    return filesBelow(argument, rule);
  }
  if (fs::exists(status))
  {
    return std::vector<std::string>{ argument };
  }
  if (isCollectionAtEpoch(argument))
  {
    return std::vector<std::string>{ argument };
  }
  if (argument.find_first_of("*?[") != std::string::npos)
  {
    return filesMatching(argument, rule);
  }
  return makeError(Error::Kind::NotFound, argument + ": no such file or folder");
}
} // namespace

Result<InputFileList> findInputFiles(const std::vector<std::string>& arguments,
  const std::vector<std::string>& extensions, const PointFileTest& isPointFile,
  std::vector<InputFault>* faults, const PointFileTest& isStore)
{
  InputFileList list;
  const FolderRule rule{ extensions, isPointFile, isStore, list.warnings };
  std::vector<Error> wrong;
  for (const std::string& argument : arguments)
  {
    Result<std::vector<std::string>> files = expand(argument, rule);
    if (!files)
    {
      wrong.push_back(files.error());
      if (faults != nullptr)
      {
        faults->push_back(inputFault(argument, files.error()));
      }
      continue;
    }
    list.paths.insert(list.paths.end(), files->begin(), files->end());
  }
  if (!wrong.empty() && (faults == nullptr || list.paths.empty()))
  {
    return faultyInputs(wrong, arguments.size());
  }
  std::sort(list.paths.begin(), list.paths.end());

  std::map<std::optional<std::string>, FileNames> seen; // for each epoch
  std::vector<std::string> once;
  for (const std::string& path : list.paths)
  {
    const EpochAddress asked = EpochAddress::of(path);
    if (const std::optional<std::string> first = seen[asked.epoch].add(asked.file))
    {
      const EpochAddress before{ *first, asked.epoch };
      list.warnings.push_back(path + " is the same file as " + before.text() + ": read once");
    }
    else
    {
      once.push_back(path);
    }
  }
  list.paths = std::move(once);
  return list;
}

} // namespace pointfront
