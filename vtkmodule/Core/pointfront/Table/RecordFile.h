#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Table/RecordEncoder.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A file being written: a text header that says how many points there are, then their records.
/// Whole or absent, as PointSink asks. The header is written twice: with no points, and, once they
/// are counted, with their number; its length does not depend on it.
/// Threads  one thread. Errors  of OutputFile.
class RecordFile
{
public:
  using Header = std::function<std::string(std::uint64_t points)>;

  static Result<std::unique_ptr<RecordFile>> create(
    const std::string& path, RecordEncoder encoder, Header header);

  Result<void> append(const PointBatch& batch);
  Result<void> finish();
  std::vector<std::string> findings() const { return encoder_.findings(); }

private:
  RecordFile(RecordEncoder encoder, Header header, std::unique_ptr<OutputFile> file)
    : encoder_(std::move(encoder))
    , header_(std::move(header))
    , file_(std::move(file))
  {
  }

  RecordEncoder encoder_;
  Header header_;
  std::unique_ptr<OutputFile> file_;
  std::vector<std::byte> records_; ///< records of one batch
  std::uint64_t points_ = 0;
};

/// The number, filled up with blanks to the length that every 64-bit number has room in.
std::string paddedCount(std::uint64_t count);
/// A name for a field: what is no letter, digit or one of "_[]" becomes "_".
std::string fieldName(const std::string& attribute);

} // namespace pointfront
