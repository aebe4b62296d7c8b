#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ParallelChunks.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace pointfront
{

struct EPTFolder;
class EPTNodeDecoder;

/// Entwine trees, by their ept.json: nodes of laszip, binary or zstandard. Every point of every
/// node is read; the tree's own hierarchy counts for nothing else.
class EPTFormat final : public PointSourceFormat
{
public:
  /// Opens a LAZ file by its path, for messages, and its bytes, which outlive what is opened.
  using Opener =
    std::function<Result<std::unique_ptr<PointSource>>(const std::string&, const RawBytes&)>;
  /// `openNode`: readers do not know each other.
  explicit EPTFormat(Opener openNode, SurveyOptions survey = {})
    : openNode_(std::move(openNode))
    , survey_(std::move(survey))
  {
  }
  std::string name() const override { return "EPT"; }
  std::vector<std::string> extensions() const override { return {}; }
  /// By the name "ept.json".
  bool accepts(const std::string& path) const override;
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;
  /// The decoder of the nodes, for a tree that has some.
  Result<std::shared_ptr<const EPTNodeDecoder>> decoderOf(
    std::shared_ptr<const EPTFolder> tree) const;
  /// Describes the source, by the nodes and by the tree.
  static SourceDescription describe(const EPTNodeDecoder& nodes, const EPTFolder& tree);

private:
  Opener openNode_;
  SurveyOptions survey_;
};

} // namespace pointfront
