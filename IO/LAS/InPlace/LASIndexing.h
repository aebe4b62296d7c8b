#pragma once

#include "LASFile.h"

#include "pointfront/Base/Progress.h"
#include "pointfront/InPlace/InPlaceTable.h"
#include "pointfront/InPlace/SideFile.h"
#include "pointfront/Points/AttributePass.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The name of a LAS file's index that is given no other: beside the file, with this behind.
constexpr const char* lasIndexSuffix = ".pfindex";

struct LASIndexOptions
{
  std::uint32_t leafPoints = 16384;
  std::uint64_t memoryBytes = 0; ///< 0: 256 MiB
  unsigned threads = 0; ///< 0: one a core
  std::string temporaryFolder; ///< empty: the side file's
  bool overwrite = false; ///< false: an index that is there is an Error
  /// Gives the points an attribute "normal", which is kept in the side file (6 bytes a point before
  /// compression). None: normals are computed while nodes load, for who asks.
  std::shared_ptr<const AttributePass> normals;
  std::string normalsOrigin; ///< for the user: "of scan-line neighbours"
};

struct LASIndexReport
{
  std::uint64_t points = 0;
  std::uint64_t nodes = 0;
  std::uint64_t runs = 0; ///< runs of consecutive points, over all leaves
  std::uint64_t bytesWritten = 0; ///< size of the side file
  std::uint64_t spilledBytes = 0;
  double seconds = 0.0;
  std::vector<std::string> warnings;
};

/// Makes the in-place quadtree of a LAS file: a side file that tells which runs of its points lie
/// where. The LAS file is read, never written; nothing of it is copied.
/// Memory   that of indexInPlace() and of the pass that computes normals, one after the other.
/// Order    the side file's bytes depend on the LAS file and the options only, not on threads.
/// Errors   of LASFile::open; Unsupported for LAZ (its points have no places of their own);
///          those of checkOutputTarget(); BadArgument: normals for a file that has some; Corrupt if
///          the file changes meanwhile; Unwritable; Cancelled. Nothing is left behind then.
/// Source   Kovac 2009, sections 2, 3.1 and 3.2.
Result<LASIndexReport> indexLASFile(const std::string& lasPath, const std::string& sidePath,
  const LASIndexOptions& options, const ProgressFunction& progress = {});

/// The Error that indexLASFile() would begin with, if the file is none that can be indexed.
Result<void> checkIndexable(const std::string& lasPath);

/// The records of an open, uncompressed LAS file whose records were counted.
GridRecords recordsOf(const LASFile& file);
/// How a side file knows `file` again; its name is left empty.
IndexedFile identityOf(const LASFile& file);

} // namespace pointfront
