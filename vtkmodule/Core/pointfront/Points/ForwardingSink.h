#pragma once

#include "pointfront/Points/PointSink.h"

#include <memory>
#include <utility>

namespace pointfront
{

/// A sink that changes points on their way into another one, which makes the file. A derived class
/// overrides the calls that it changes, and calls them here to pass on what it made of them.
class ForwardingSink : public PointSink
{
public:
  std::string path() const override { return sink_->path(); }
  Result<void> begin(const SinkDescription& description) override
  {
    return sink_->begin(description);
  }
  Result<void> append(const PointBatch& batch) override { return sink_->append(batch); }
  Result<void> finish() override { return sink_->finish(); }
  std::vector<std::string> findings() const override { return sink_->findings(); }

protected:
  explicit ForwardingSink(std::unique_ptr<PointSink> sink)
    : sink_(std::move(sink))
  {
  }

private:
  std::unique_ptr<PointSink> sink_;
};

} // namespace pointfront
