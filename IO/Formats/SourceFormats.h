#pragma once

#include "TextFormat.h"

#include "pointfront/Points/PointFileOpener.h"
#include "pointfront/Query/InputBox.h"
#include "pointfront/Table/ParallelChunks.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The user's choices of how point files are opened.
struct SourceOptions
{
  std::vector<std::string> columns; ///< for text files; empty: by header or guess
  TextChoice text; ///< for text files
  SurveyOptions survey; ///< for files that are looked through when they are opened
  std::string temporaryFolder; ///< for what must be unpacked; empty: the system's
  /// Files are cut to it. Of those that have an index (stores, side files, COPC, EPT, collections)
  /// only the nodes that reach into it are read.
  std::shared_ptr<InputBox> box;
};

/// The families of point files that this program reads. IO modules do not know each other: they
/// are put together here, and asked in turn.
class SourceFormats final : public PointFileOpener
{
public:
  /// All that this build carries.
  explicit SourceFormats(const SourceOptions& options = {});

  /// Lower case, without the dot.
  std::vector<std::string> extensions() const override;

  /// A store or the index of a point file: what may hold points that lie beside it once more.
  static bool isStore(const std::string& path);

  /// False for a file whose extension stands for all kinds of text (.txt, .csv, .gz ...) and in
  /// which no row of numbers is found: a note beside the points; and for the preview of a build.
  bool mayHoldPoints(const std::string& path) const;

  /// Opens with the first format that accepts the file's content; as text only what no other
  /// format's extension names. If none does, the format that the extension names says why; a file
  /// of an unknown kind is Unsupported.
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;

private:
  /// The points of a file, whole unless an index names those in the box.
  Result<std::unique_ptr<PointSource>> openUncut(const std::string& path) const;
  /// The format that the extension names, or none.
  const PointSourceFormat* named(const std::string& path) const;

  std::vector<std::unique_ptr<PointSourceFormat>> formats_;
  std::shared_ptr<InputBox> box_;
};

} // namespace pointfront
