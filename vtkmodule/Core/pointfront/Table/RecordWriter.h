#pragma once

#include "pointfront/Points/PointSink.h"
#include "pointfront/Table/RecordFile.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{
class FieldNames;

/// Writes points as one record each behind a text header, as in PLY and PCD. The format decides the
/// header, the form of x, y and z, and the rest of a record.
/// CRS         such formats have no place for it: it is lost.
/// Errors      as in PointSink.
/// Threads     one thread.
class RecordWriter : public PointSink
{
public:
  std::string path() const final { return path_; }
  Result<void> begin(const SinkDescription& description) final;
  Result<void> append(const PointBatch& batch) final;
  Result<void> finish() final;
  std::vector<std::string> findings() const override;

protected:
  explicit RecordWriter(std::string path);

private:
  /// Called once, in begin().
  virtual CoordinateCoding coordinates(const SinkDescription& description)
  {
    static_cast<void>(description);
    return {};
  }
  /// Adds the attributes to the encoder, in the order of the file, and gives the header that
  /// announces them.
  virtual RecordFile::Header describe(
    const AttributeSchema& schema, const FieldNames& names, RecordEncoder& encoder) const = 0;

  std::string path_;
  std::vector<std::string> renamed_; ///< findings about names
  std::unique_ptr<RecordFile> file_; ///< since begin()
};

} // namespace pointfront
