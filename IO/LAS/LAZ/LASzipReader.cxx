#include "LASzipReader.h"

#include "StackGuard.h"

#include "pointfront/Base/PrintableText.h"

#include <laszip/laszip_api.h>

#include <istream>
#include <streambuf>
#include <utility>

namespace pointfront
{
namespace
{
/// Two runs of memory, one behind the other, as a stream that can be read and positioned.
class TwoPartBuffer final : public std::streambuf
{
public:
  TwoPartBuffer(std::vector<std::byte> first, ByteSpan second)
    : first_(std::move(first))
    , second_(second)
  {
    enter(0, 0);
  }

  std::size_t position() const
  {
    return (part_ == 0 ? 0 : first_.size()) + static_cast<std::size_t>(gptr() - eback());
  }
  std::size_t firstBytes() const { return first_.size(); }

protected:
  int_type underflow() override
  {
    if (gptr() == egptr() && part_ == 0)
    {
      enter(1, 0);
    }
    return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir way, std::ios_base::openmode) override
  {
    const auto size = static_cast<off_type>(first_.size() + second_.size);
    off_type base = way == std::ios_base::end ? size : 0;
    base = way == std::ios_base::cur ? static_cast<off_type>(position()) : base;
    const off_type target = base + offset;
    if (target < 0 || target > size)
    {
      return pos_type(off_type(-1));
    }
    const auto place = static_cast<std::size_t>(target);
    place < first_.size() ? enter(0, place) : enter(1, place - first_.size());
    return target;
  }

  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override
  {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }

private:
  void enter(int part, std::size_t at)
  {
    // streambuf wants char*; nothing is ever written through it.
    const std::byte* data = part == 0 ? first_.data() : second_.data;
    const std::size_t size = part == 0 ? first_.size() : second_.size;
    char* begin = reinterpret_cast<char*>(const_cast<std::byte*>(data));
    part_ = part;
    setg(begin, begin + at, begin + size);
  }

  std::vector<std::byte> first_;
  ByteSpan second_;
  int part_ = 0;
};

/// LASzip's point of formats 6 to 10 back into the 30 bytes of the standard.
void storePoint14(const laszip_point& point, std::byte* to)
{
  std::memcpy(to, &point.X, 12);
  storeNumber(to + 12, point.intensity);
  const unsigned returns =
    point.extended_return_number | unsigned(point.extended_number_of_returns) << 4;
  const unsigned flags = point.extended_classification_flags |
    unsigned(point.extended_scanner_channel) << 4 | unsigned(point.scan_direction_flag) << 6 |
    unsigned(point.edge_of_flight_line) << 7;
  storeNumber(to + 14, static_cast<std::uint8_t>(returns));
  storeNumber(to + 15, static_cast<std::uint8_t>(flags));
  storeNumber(to + 16, point.extended_classification);
  storeNumber(to + 17, point.user_data);
  storeNumber(to + 18, point.extended_scan_angle);
  storeNumber(to + 20, point.point_source_ID);
  storeNumber(to + 22, point.gps_time);
}

void storeRecord(const laszip_point& point, const LASPointLayout& layout, std::byte* to)
{
  const LASFormatParts& parts = lasFormatParts(layout.pointFormat);
  if (layout.pointFormat >= 6)
  {
    storePoint14(point, to);
  }
  else
  {
    std::memcpy(to, &point.X, 20); // the first 20 bytes of laszip_point are those of the standard
    if (parts.gpsTime != 0)
    {
      storeNumber(to + parts.gpsTime, point.gps_time);
    }
  }
  if (parts.rgb != 0)
  {
    std::memcpy(to + parts.rgb, point.rgb, 6);
  }
  if (parts.nir != 0)
  {
    std::memcpy(to + parts.nir, point.rgb + 3, 2);
  }
  if (parts.wave != 0)
  {
    std::memcpy(to + parts.wave, point.wave_packet, 29);
  }
  if (layout.pointBytes > parts.bytes)
  {
    std::memcpy(to + parts.bytes, point.extra_bytes, layout.pointBytes - parts.bytes);
  }
}
} // namespace

std::uint32_t laszipLayers(const LASPointLayout& layout, const std::vector<std::uint32_t>& columns)
{
  const LASFormatParts& parts = lasFormatParts(layout.pointFormat);
  std::uint32_t layers = laszip_DECOMPRESS_SELECTIVE_Z;
  for (const std::uint32_t column : columns)
  {
    const std::size_t at = layout.fields[column].offset;
    const auto isIn = [at](std::size_t part) { return part != 0 && at >= part; };
    layers |= at >= parts.bytes ? laszip_DECOMPRESS_SELECTIVE_EXTRA_BYTES
      : isIn(parts.wave)        ? laszip_DECOMPRESS_SELECTIVE_WAVEPACKET
      : isIn(parts.nir)         ? laszip_DECOMPRESS_SELECTIVE_NIR
      : isIn(parts.rgb)         ? laszip_DECOMPRESS_SELECTIVE_RGB
      : at >= 22                ? laszip_DECOMPRESS_SELECTIVE_GPS_TIME
      : at >= 20                ? laszip_DECOMPRESS_SELECTIVE_POINT_SOURCE
      : at >= 18                ? laszip_DECOMPRESS_SELECTIVE_SCAN_ANGLE
      : at == 17                ? laszip_DECOMPRESS_SELECTIVE_USER_DATA
      : at == 16                ? laszip_DECOMPRESS_SELECTIVE_CLASSIFICATION
      : at == 15                ? laszip_DECOMPRESS_SELECTIVE_FLAGS
      : at >= 14                ? laszip_DECOMPRESS_SELECTIVE_CHANNEL_RETURNS_XY
                                : laszip_DECOMPRESS_SELECTIVE_INTENSITY;
  }
  return layers;
}

struct LASzipReader::Handle
{
  Handle(std::vector<std::byte> beginning, ByteSpan chunk, const LASPointLayout& pointLayout)
    : buffer(std::move(beginning), chunk)
    , stream(&buffer)
    , layout(&pointLayout)
  {
  }
  ~Handle()
  {
    if (laszip == nullptr)
    {
      return;
    }
    // Their results do not matter any more: the handle goes either way.
    if (opened)
    {
      laszip_close_reader(laszip);
    }
    laszip_destroy(laszip);
  }

  TwoPartBuffer buffer;
  std::istream stream;
  const LASPointLayout* layout;
  laszip_POINTER laszip = nullptr;
  laszip_point_struct* point = nullptr;
  bool opened = false;
  bool overflowed = false; ///< LASzip is somewhere inside: it may only be destroyed
};

LASzipReader::LASzipReader(std::unique_ptr<Handle> handle)
  : handle_(std::move(handle))
{
}
LASzipReader::LASzipReader(LASzipReader&&) noexcept = default;
LASzipReader& LASzipReader::operator=(LASzipReader&&) noexcept = default;
LASzipReader::~LASzipReader() = default;

Result<LASzipReader> LASzipReader::open(const LASFile& file, const LAZCompression& compression,
  ByteSpan chunk, std::uint32_t points, std::uint32_t layers)
{
  auto handle =
    std::make_unique<Handle>(composeLAZBeginning(file, compression, points), chunk, file.layout);
  laszip_BOOL compressed = 0;
  if (laszip_create(&handle->laszip) != 0)
  {
    return makeError(Error::Kind::NoMemory, file.description.path + ": LASzip did not start");
  }
  if (layers != laszipAllLayers)
  {
    laszip_decompress_selective(handle->laszip, layers);
  }
  handle->opened = laszip_open_reader_stream(handle->laszip, handle->stream, &compressed) == 0;
  if (!handle->opened || laszip_get_point_pointer(handle->laszip, &handle->point) != 0)
  {
    laszip_CHAR* words = nullptr;
    laszip_get_error(handle->laszip, &words);
    return makeError(Error::Kind::Unsupported,
      file.description.path +
        ": LASzip refuses it: " + printableText(words != nullptr ? words : "no reason given"));
  }
  return LASzipReader(std::move(handle));
}

std::size_t LASzipReader::read(std::size_t count, std::byte* to)
{
  const LASPointLayout& layout = *handle_->layout;
  if (handle_->overflowed)
  {
    return 0;
  }
  // Kept outside of the body, which may be left in the middle.
  volatile std::size_t done = 0;
  const auto body = [&]
  {
    for (; done < count && laszip_read_point(handle_->laszip) == 0; done = done + 1)
    {
      storeRecord(*handle_->point, layout, to + done * layout.pointBytes);
    }
  };
  // LASzip follows a change of the sequence of GPS times by recursion; bytes that say nothing else
  // but such changes make it endless.
  handle_->overflowed = !runWithinStack(body);
  return done;
}

std::size_t LASzipReader::consumed() const
{
  const std::size_t position = handle_->buffer.position();
  const std::size_t beginning = handle_->buffer.firstBytes();
  return position < beginning ? 0 : position - beginning;
}

} // namespace pointfront
