#include "LASzipWriter.h"

#include "LASBytes.h"
#include "LASRecords.h"

#include "pointfront/Base/PrintableText.h"

#include <laszip/laszip_api.h>

#include <optional>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
/// An OutputFile as a stream that can go back to overwrite what it wrote.
/// After a failed write it keeps the first Error and takes bytes without writing them: LASzip
/// loses memory when its stream goes bad, so it is not told; the owner of the buffer asks.
class FileBuffer final : public std::streambuf
{
public:
  FileBuffer(OutputFile& file, std::uint64_t offset)
    : file_(file)
    , end_(offset)
    , position_(offset)
  {
  }

  const std::optional<Error>& error() const { return error_; }
  std::uint64_t end() const { return end_ + pending_.size(); }
  /// Hands what is pending to the file.
  void flush()
  {
    keepError([this] { return file_.append(pending_.data(), pending_.size()); });
    end_ += pending_.size();
    pending_.clear();
  }

protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override
  {
    const auto* data = reinterpret_cast<const std::byte*>(text);
    const auto size = static_cast<std::size_t>(count);
    if (position_ == end())
    {
      pending_.insert(pending_.end(), data, data + size);
      if (pending_.size() >= flushBytes)
      {
        flush();
      }
    }
    else
    {
      // Back in what was written: LASzip does so once, for the place of its chunk table.
      flush();
      keepError([&] { return file_.overwrite(position_, data, size); });
    }
    position_ += size;
    return count;
  }

  int_type overflow(int_type character) override
  {
    const char one = traits_type::to_char_type(character);
    xsputn(&one, 1);
    return character;
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override
  {
    off_type base = way == std::ios_base::end ? static_cast<off_type>(end()) : 0;
    base = way == std::ios_base::cur ? static_cast<off_type>(position_) : base;
    const off_type target = base + offset;
    if (target < 0 || target > static_cast<off_type>(end()))
    {
      return pos_type(off_type(-1));
    }
    position_ = static_cast<std::uint64_t>(target);
    return target;
  }

  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override
  {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }

private:
  static constexpr std::size_t flushBytes = 1 << 20;

  template <typename Write>
  void keepError(const Write& write)
  {
    if (error_)
    {
      return;
    }
    if (const Result<void> done = write(); !done)
    {
      error_ = done.error();
    }
  }

  OutputFile& file_;
  std::optional<Error> error_;
  std::uint64_t end_;
  std::uint64_t position_;
  std::vector<std::byte> pending_;
};

/// LASzip's word for chunks that end where the writer says so: here, at the end.
constexpr laszip_U32 variableChunks = 0xFFFFFFFFu;

/// The 30 bytes of formats 6 to 10 into LASzip's point. Its old fields must repeat the flags.
void loadPoint14(const std::byte* from, laszip_point& point)
{
  std::memcpy(&point.X, from, 12);
  point.intensity = loadNumber<std::uint16_t>(from + 12);
  const unsigned returns = loadNumber<std::uint8_t>(from + 14);
  const unsigned flags = loadNumber<std::uint8_t>(from + 15);
  point.extended_point_type = 1;
  point.extended_return_number = returns & 15;
  point.extended_number_of_returns = (returns >> 4) & 15;
  point.extended_classification_flags = flags & 15;
  point.extended_scanner_channel = (flags >> 4) & 3;
  point.scan_direction_flag = (flags >> 6) & 1;
  point.edge_of_flight_line = (flags >> 7) & 1;
  point.synthetic_flag = flags & 1;
  point.keypoint_flag = (flags >> 1) & 1;
  point.withheld_flag = (flags >> 2) & 1;
  point.extended_classification = loadNumber<std::uint8_t>(from + 16);
  point.user_data = loadNumber<std::uint8_t>(from + 17);
  point.extended_scan_angle = loadNumber<std::int16_t>(from + 18);
  point.point_source_ID = loadNumber<std::uint16_t>(from + 20);
  point.gps_time = loadNumber<double>(from + 22);
}

void loadRecord(const std::byte* from, const LASPointLayout& layout, laszip_point& point)
{
  const LASFormatParts& parts = lasFormatParts(layout.pointFormat);
  if (layout.pointFormat >= 6)
  {
    loadPoint14(from, point);
  }
  else
  {
    std::memcpy(&point.X, from, 20); // the first 20 bytes of laszip_point are those of the standard
    if (parts.gpsTime != 0)
    {
      point.gps_time = loadNumber<double>(from + parts.gpsTime);
    }
  }
  if (parts.rgb != 0)
  {
    std::memcpy(point.rgb, from + parts.rgb, 6);
  }
  if (parts.nir != 0)
  {
    std::memcpy(point.rgb + 3, from + parts.nir, 2);
  }
  if (parts.wave != 0)
  {
    std::memcpy(point.wave_packet, from + parts.wave, 29);
  }
  if (layout.pointBytes > parts.bytes)
  {
    std::memcpy(point.extra_bytes, from + parts.bytes, layout.pointBytes - parts.bytes);
  }
}
} // namespace

struct LASzipWriter::Handle
{
  ~Handle()
  {
    if (laszip == nullptr)
    {
      return;
    }
    // Their results do not matter any more: the handle goes either way.
    if (opened)
    {
      laszip_close_writer(laszip);
    }
    laszip_destroy(laszip);
  }

  Result<void> open()
  {
    constexpr laszip_BOOL compress = 1;
    constexpr laszip_BOOL withoutHeader = 1;
    opened = laszip_open_writer_stream(laszip, *stream, compress, withoutHeader) == 0;
    if (!opened || laszip_get_point_pointer(laszip, &point) != 0)
    {
      return error("begin");
    }
    return {};
  }

  Error error(const std::string& what) const
  {
    if (buffer && buffer->error())
    {
      return *buffer->error(); // the disk's reason is the first cause
    }
    laszip_CHAR* words = nullptr;
    laszip_get_error(laszip, &words);
    return makeError(Error::Kind::Unwritable,
      path + ": LASzip cannot " + what + ": " +
        printableText(words != nullptr ? words : "no reason given"));
  }

  std::string path;
  const LASPointLayout* layout = nullptr;
  std::unique_ptr<FileBuffer> buffer; ///< or
  std::unique_ptr<std::stringbuf> chunk; ///< in memory
  std::unique_ptr<std::ostream> stream;
  laszip_POINTER laszip = nullptr;
  laszip_point_struct* point = nullptr;
  bool opened = false;
};

LASzipWriter::LASzipWriter(std::unique_ptr<Handle> handle)
  : handle_(std::move(handle))
{
}
LASzipWriter::LASzipWriter(LASzipWriter&&) noexcept = default;
LASzipWriter& LASzipWriter::operator=(LASzipWriter&&) noexcept = default;
LASzipWriter::~LASzipWriter() = default;

Result<LASzipWriter> LASzipWriter::create(
  const LASPointLayout& layout, const std::string& path, Chunks chunks)
{
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  handle->layout = &layout;
  if (laszip_create(&handle->laszip) != 0)
  {
    return makeError(Error::Kind::NoMemory, path + ": LASzip did not start");
  }
  const auto format = static_cast<laszip_U8>(layout.pointFormat);
  const auto bytes = static_cast<laszip_U16>(layout.pointBytes);
  if (laszip_set_point_type_and_size(handle->laszip, format, bytes) != 0 ||
    laszip_request_native_extension(handle->laszip, 1) != 0 ||
    (chunks == Chunks::Variable && laszip_set_chunk_size(handle->laszip, variableChunks) != 0))
  {
    return handle->error("compress these points");
  }
  return LASzipWriter(std::move(handle));
}

Result<MetadataRecord> LASzipWriter::compressionRecord() const
{
  laszip_U8* bytes = nullptr;
  laszip_U32 size = 0;
  if (laszip_create_laszip_vlr(handle_->laszip, &bytes, &size) != 0 || size < lasRecordHeaderBytes)
  {
    return handle_->error("describe its compression");
  }
  const auto* record = reinterpret_cast<const std::byte*>(bytes);
  return MetadataRecord{ loadText(record + 2, 16), loadNumber<std::uint16_t>(record + 18),
    loadText(record + 22, 32), { record + lasRecordHeaderBytes, record + size } };
}

Result<void> LASzipWriter::begin(OutputFile& file, std::uint64_t offset)
{
  handle_->buffer = std::make_unique<FileBuffer>(file, offset);
  handle_->stream = std::make_unique<std::ostream>(handle_->buffer.get());
  return handle_->open();
}

Result<void> LASzipWriter::beginChunk()
{
  handle_->chunk = std::make_unique<std::stringbuf>(std::ios_base::in | std::ios_base::out);
  handle_->stream = std::make_unique<std::ostream>(handle_->chunk.get());
  return handle_->open();
}

Result<void> LASzipWriter::append(const std::byte* records, std::size_t count)
{
  const LASPointLayout& layout = *handle_->layout;
  for (std::size_t i = 0; i < count; ++i, records += layout.pointBytes)
  {
    loadRecord(records, layout, *handle_->point);
    if (laszip_write_point(handle_->laszip) != 0)
    {
      return handle_->error("compress a point");
    }
  }
  const bool failed = handle_->buffer && handle_->buffer->error();
  return failed ? Result<void>(*handle_->buffer->error()) : Result<void>();
}

Result<std::uint64_t> LASzipWriter::finish()
{
  handle_->opened = false;
  const bool closed = laszip_close_writer(handle_->laszip) == 0;
  handle_->buffer->flush();
  if (!closed || handle_->buffer->error())
  {
    return handle_->error("finish");
  }
  return handle_->buffer->end();
}

/// LASzip wrote the address of a chunk table, the chunk and the table.
Result<std::vector<std::byte>> LASzipWriter::finishChunk()
{
  handle_->opened = false;
  const bool closed = laszip_close_writer(handle_->laszip) == 0;
  const std::string text = handle_->chunk->str();
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  constexpr std::uint64_t begin = sizeof(std::uint64_t);
  const std::uint64_t end = text.size() < begin ? 0 : loadNumber<std::uint64_t>(bytes);
  if (!closed || end < begin || end > text.size())
  {
    return handle_->error("finish a chunk");
  }
  return std::vector<std::byte>(bytes + begin, bytes + end);
}

} // namespace pointfront
