#pragma once

#include "pointfront/Base/Result.h"

#include <string>
#include <vector>

namespace pointfront
{

/// The kind of a file that this project writes, told by its first bytes. An empty file counts as
/// every kind: somebody reserved the name.
enum class FileKind
{
  Store,
  SideFile,
  Collection,
  LAS, ///< LAZ too, and COPC where a file is there already
  COPC, ///< a target
  PLY,
  PCD,
  Text, ///< rows of numbers, as far as anyone can tell: text that is none of the others
  Picture, ///< PNG, JPEG, TIFF, BMP
  Statistics, ///< JSON that `render`, `bench` and `export` wrote
  FrameTable, ///< CSV that `bench` wrote
  Other
};

/// A file that is about to be written.
struct OutputTarget
{
  std::string path;
  FileKind kind = FileKind::Other;
  bool replace = false; ///< a file of that kind that is there already
};

/// True if both names lead to one file: the same name, a symbolic or a hard link. A name of nothing
/// is no file.
bool sameFile(const std::string& one, const std::string& other);

/// Whether `path` is none of `reads`. BadArgument if it is; an empty path is none.
Result<void> checkApart(const std::string& path, const std::vector<std::string>& reads);

/// Asked before anything is written and before hours of work. The kernel asks it where it knows
/// what is read (buildStore, exportStore, indexLASFile); a program also where it knows more.
/// `reads`  files that the same work reads: checkApart().
/// Errors   BadArgument: the target is one of `reads`, is a folder or a device, is a file of
///          another kind, which is never replaced, or is named as one of another kind (a store
///          *.las, plain LAZ *.copc.laz), which no program would then read. Unwritable: it is there
///          and `replace` is false.
Result<void> checkOutputTarget(
  const OutputTarget& target, const std::vector<std::string>& reads = {});

} // namespace pointfront
