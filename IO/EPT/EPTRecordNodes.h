#pragma once

#include "EPTNodeDecoder.h"
#include "EPTRecords.h"

#include "pointfront/Table/TableSource.h"

#include <memory>
#include <utility>

namespace pointfront
{

/// The binary or zstandard files of an Entwine tree.
class EPTRecordNodes final : public EPTNodeDecoder
{
public:
  /// Errors  of EPTRecords and TableSource.
  static Result<std::unique_ptr<EPTNodeDecoder>> open(
    std::shared_ptr<const EPTFolder> tree, const SurveyOptions& survey)
  {
    Result<std::unique_ptr<EPTRecords>> records = EPTRecords::open(std::move(tree));
    if (!records)
    {
      return records.error();
    }
    const EPTRecords& table = **records;
    Result<std::unique_ptr<TableSource>> points = TableSource::make(std::move(*records), survey);
    if (!points)
    {
      return points.error();
    }
    return std::unique_ptr<EPTNodeDecoder>(new EPTRecordNodes(std::move(*points), table));
  }
  const SourceDescription& description() const override { return points_->description(); }
  Result<void> decode(const EPTNode& node, const RawBytes& file, PointBatch& batch) const override
  {
    TableBlock block;
    Result<void> done = records_.decode(node, file, points_->wanted(), block);
    if (done)
    {
      points_->convert(block, node.points, batch);
    }
    return done;
  }

private:
  EPTRecordNodes(std::unique_ptr<TableSource> points, const EPTRecords& records)
    : points_(std::move(points))
    , records_(records)
  {
  }

  std::unique_ptr<TableSource> points_; ///< owns the records
  const EPTRecords& records_;
};

} // namespace pointfront
