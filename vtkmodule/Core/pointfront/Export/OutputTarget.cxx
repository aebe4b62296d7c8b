#include "pointfront/Export/OutputTarget.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Disk/SmallFile.h"
#include "pointfront/InPlace/SideFile.h"
#include "pointfront/Store/PointStore.h"

#include <string_view>

#include <sys/stat.h>

namespace pointfront
{
namespace
{
constexpr std::size_t looked = 4096; // bytes

bool startsWith(std::string_view text, std::string_view start)
{
  return text.substr(0, start.size()) == start;
}

bool contains(std::string_view text, std::string_view part)
{
  return text.find(part) != std::string_view::npos;
}

bool isPicture(std::string_view bytes)
{
  using namespace std::string_view_literals;
  return startsWith(bytes, "\x89PNG"sv) || startsWith(bytes, "\xff\xd8\xff"sv) ||
    startsWith(bytes, "II*\0"sv) || startsWith(bytes, "MM\0*"sv) || startsWith(bytes, "BM"sv);
}

FileKind kindOfText(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const char begin = first == std::string_view::npos ? ' ' : text[first];
  if (begin == '{' || begin == '[')
  {
    const bool known = contains(text, "\"points_drawn\"") || contains(text, "\"points_written\"");
    return known ? FileKind::Statistics : FileKind::Other;
  }
  return startsWith(text, "frame,ms,") ? FileKind::FrameTable : FileKind::Text;
}

FileKind kindOf(const std::string& path)
{
  if (PointStore::looksLikeCollection(path))
  {
    return FileKind::Collection;
  }
  if (PointStore::looksLikeStore(path))
  {
    return FileKind::Store;
  }
  if (SideFile::looksLikeSideFile(path))
  {
    return FileKind::SideFile;
  }
  const std::string bytes = beginningOf(path, looked);
  if (startsWith(bytes, "LASF"))
  {
    return FileKind::LAS;
  }
  if (startsWith(bytes, "ply\n") || startsWith(bytes, "ply\r"))
  {
    return FileKind::PLY;
  }
  if (startsWith(bytes, "# .PCD") || (contains(bytes, "FIELDS ") && contains(bytes, "POINTS ")))
  {
    return FileKind::PCD;
  }
  if (isPicture(bytes))
  {
    return FileKind::Picture;
  }
  return contains(bytes, std::string_view("\0", 1)) ? FileKind::Other : kindOfText(bytes);
}

const char* nameOf(FileKind kind)
{
  switch (kind)
  {
    case FileKind::Store:
      return "a store";
    case FileKind::SideFile:
      return "an index";
    case FileKind::Collection:
      return "a collection";
    case FileKind::LAS:
      return "a LAS or LAZ file";
    case FileKind::COPC:
      return "COPC";
    case FileKind::PLY:
      return "a PLY file";
    case FileKind::PCD:
      return "a PCD file";
    case FileKind::Text:
      return "a text file";
    case FileKind::Picture:
      return "a picture";
    case FileKind::Statistics:
      return "a file of statistics";
    case FileKind::FrameTable:
      return "a table of frames";
    case FileKind::Other:
      break;
  }
  return "a file of another kind";
}

Error refusal(const OutputTarget& target, const std::string& why)
{
  return makeError(Error::Kind::BadArgument, target.path + ": " + why);
}

/// The kind that all see in a file of that name; Other: the name says nothing.
FileKind kindOfName(const std::string& path)
{
  struct Ending
  {
    const char* text;
    FileKind kind;
  };
  constexpr Ending endings[] = { { ".las", FileKind::LAS }, { ".laz", FileKind::LAS },
    { ".ply", FileKind::PLY }, { ".pcd", FileKind::PCD }, { ".csv", FileKind::Text },
    { ".xyz", FileKind::Text }, { ".txt", FileKind::Text }, { ".png", FileKind::Picture },
    { ".pfront", FileKind::Store }, { ".pfindex", FileKind::SideFile },
    { ".pfcollection", FileKind::Collection } };
  for (const Ending& ending : endings)
  {
    if (endsWithoutCase(path, ending.text))
    {
      return ending.kind;
    }
  }
  return FileKind::Other;
}

/// A name tells programs what to read a file as.
Result<void> checkName(const OutputTarget& target)
{
  const bool copc = endsWithoutCase(target.path, ".copc.laz");
  if (target.kind == FileKind::LAS && copc)
  {
    return refusal(target, "is named as COPC, which is not written here; leave out '.copc'");
  }
  if (target.kind == FileKind::COPC && !copc)
  {
    return refusal(target, "would be COPC; let the name end in .copc.laz");
  }
  const FileKind named = kindOfName(target.path);
  const bool collection = target.kind == FileKind::Collection;
  const bool cloud =
    target.kind == FileKind::Store || target.kind == FileKind::SideFile || collection;
  const bool index = target.kind == FileKind::SideFile && named == FileKind::Store; // drawn alike
  if (cloud && !index && named != FileKind::Other && named != target.kind)
  {
    return refusal(target,
      std::string("is named as ") + nameOf(named) + " and would be " + nameOf(target.kind) +
        "; let the name end in " +
        (target.kind == FileKind::Store ? ".pfront"
            : collection                ? ".pfcollection"
                                        : ".pfindex"));
  }
  return {};
}
} // namespace

bool sameFile(const std::string& one, const std::string& other)
{
  struct stat a = {};
  struct stat b = {};
  return ::stat(one.c_str(), &a) == 0 && ::stat(other.c_str(), &b) == 0 && a.st_dev == b.st_dev &&
    a.st_ino == b.st_ino;
}

Result<void> checkApart(const std::string& path, const std::vector<std::string>& reads)
{
  for (const std::string& input : reads)
  {
    if (sameFile(path, input))
    {
      return makeError(Error::Kind::BadArgument,
        path + ": would be written over '" + input + "', which is read; give another name");
    }
  }
  return {};
}

Result<void> checkOutputTarget(const OutputTarget& target, const std::vector<std::string>& reads)
{
  if (Result<void> named = checkName(target); !named)
  {
    return named;
  }
  if (Result<void> apart = checkApart(target.path, reads); !apart)
  {
    return apart;
  }
  struct stat state = {};
  if (::stat(target.path.c_str(), &state) != 0)
  {
    return {};
  }
  if (!S_ISREG(state.st_mode))
  {
    return refusal(target,
      std::string(S_ISDIR(state.st_mode) ? "is a folder" : "is no ordinary file") +
        "; give another name");
  }
  if (state.st_size > 0)
  {
    const FileKind there = kindOf(target.path);
    if (there != (target.kind == FileKind::COPC ? FileKind::LAS : target.kind))
    {
      return refusal(target,
        std::string("is there already and is ") + nameOf(there) + ", which " + nameOf(target.kind) +
          " does not replace; give another name");
    }
  }
  if (!target.replace)
  {
    return makeError(Error::Kind::Unwritable,
      target.path + ": exists already; allow that it is replaced (--force), or give another name");
  }
  return {};
}

} // namespace pointfront
