#pragma once

#include "LASExport.h"

#include "pointfront/Points/PointSink.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Writes points as LAS, or as LAZ through LASzip (chunks of 50,000 points).
/// Format      the smallest that holds the schema's attributes: point formats 0 to 5 unless there
///             is a scanner channel, near infrared, a class above 31 or an 8th return; then 6 to
///             10. LAS 1.2 where it suffices, 1.3 for wave packets, 1.4 for the rest.
/// Extra       attributes that are not LAS fields, or that a field of their name does not hold,
///             become extra bytes, with their descriptors.
/// Exactness   the integers of the grid, and every attribute that came from a LAS file, are written
///             as they were; colour of 8 bit is written as it is, not spread over 16 bit.
/// Errors      as in PointSink; BadArgument names the attribute or coordinate that does not fit.
/// Threads     one thread.
class LASWriter final : public PointSink
{
public:
  enum class Encoding
  {
    Las,
    Laz
  };

  /// `created`: what the header says of the day; today by default.
  explicit LASWriter(
    std::string path, Encoding encoding = Encoding::Las, LASDate created = LASDate::today());
  ~LASWriter() override;
  LASWriter(const LASWriter&) = delete;
  LASWriter& operator=(const LASWriter&) = delete;

  std::string path() const override;
  Result<void> begin(const SinkDescription& description) override;
  Result<void> append(const PointBatch& batch) override;
  Result<void> finish() override;
  std::vector<std::string> findings() const override;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
