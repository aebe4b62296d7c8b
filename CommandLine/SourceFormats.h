#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ParallelChunks.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// What the user says about how point files are opened.
struct SourceOptions
{
  SurveyOptions survey; ///< of files that are looked through when they are opened
};

/// The families of point files that this program reads. IO modules do not know each other: they
/// are put together here, and asked in turn.
class SourceFormats
{
public:
  /// All that this build carries.
  explicit SourceFormats(const SourceOptions& options = {});

  /// Lower case, without the dot.
  std::vector<std::string> extensions() const;

  /// Opens with the first format that accepts the file's content. If none does, the format that
  /// the extension names says why; a file of an unknown kind is Unsupported.
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const;

private:
  std::vector<std::unique_ptr<PointSourceFormat>> formats_;
};

} // namespace pointfront
