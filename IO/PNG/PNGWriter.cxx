#include "PNGWriter.h"

#include "pointfront/Disk/OutputFile.h"

#include <cassert>
#include <csetjmp>
#include <optional>
#include <png.h>
#include <utility>

namespace pointfront
{
namespace
{
/// Level of zlib, without a filter: pictures of points have few alike neighbours but many colours
/// again. 50 to 150 MB/s here; what libpng chooses by itself takes 10 to 42, for files between 19 %
/// smaller and 87 % larger.
constexpr int compressionLevel = 3;
constexpr int rowFilters = PNG_FILTER_NONE;

/// libpng leaves its functions by longjmp when something is wrong. Nothing with a destructor may
/// stand between this and its calls: `calls` captures references only.
/// Returns  false after an error.
template <typename Calls>
bool completes(png_structp png, const Calls& calls)
{
  if (setjmp(png_jmpbuf(png)) != 0)
  {
    return false;
  }
  calls();
  return true;
}
} // namespace

struct PNGWriter::Stream
{
  std::unique_ptr<OutputFile> file;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::size_t rowBytes = 0;
  std::uint32_t rowsToCome = 0;
  std::optional<Error> error; ///< the first one

  ~Stream() { png_destroy_write_struct(&png, &info); }

  bool write(const png_byte* bytes, std::size_t size)
  {
    Result<void> done = file->append(reinterpret_cast<const std::byte*>(bytes), size);
    if (!done && !error)
    {
      error = done.error();
    }
    return done.ok();
  }
  void note(const char* reason)
  {
    if (!error)
    {
      error = makeError(
        Error::Kind::Unwritable, "cannot write '" + file->path() + "': libpng: " + reason);
    }
  }

  static void onWrite(png_structp png, png_bytep bytes, png_size_t size)
  {
    if (!static_cast<Stream*>(png_get_io_ptr(png))->write(bytes, size))
    {
      png_error(png, "the file cannot be written");
    }
  }
  static void onFlush(png_structp) {}
  static void onError(png_structp png, png_const_charp reason)
  {
    static_cast<Stream*>(png_get_error_ptr(png))->note(reason);
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {} // none is known for our own pictures
};

PNGWriter::PNGWriter(std::unique_ptr<Stream> stream)
  : stream_(std::move(stream))
{
}

PNGWriter::~PNGWriter() = default;

Result<std::unique_ptr<PNGWriter>> PNGWriter::create(
  const std::string& path, Size size, Pixels pixels)
{
  assert(size.width > 0 && size.height > 0);
  assert(size.width <= PNG_UINT_31_MAX && size.height <= PNG_UINT_31_MAX);
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path, OutputFile::Durability::None);
  if (!file)
  {
    return file.error();
  }
  auto stream = std::make_unique<Stream>();
  Stream* const state = stream.get();
  state->file = std::move(*file);
  state->rowsToCome = size.height;
  state->rowBytes = std::size_t(size.width) * (pixels == Pixels::RGB8 ? 3 : 4);
  state->png =
    png_create_write_struct(PNG_LIBPNG_VER_STRING, state, &Stream::onError, &Stream::onWarning);
  state->info = state->png != nullptr ? png_create_info_struct(state->png) : nullptr;
  if (state->info == nullptr)
  {
    return makeError(Error::Kind::NoMemory, "cannot write '" + path + "': no memory for libpng");
  }
  const int colourType = pixels == Pixels::RGB8 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA;
  const bool begun = completes(state->png,
    [&]
    {
      png_set_write_fn(state->png, state, &Stream::onWrite, &Stream::onFlush);
      png_set_user_limits(state->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
      png_set_compression_level(state->png, compressionLevel);
      png_set_filter(state->png, PNG_FILTER_TYPE_BASE, rowFilters);
      png_set_IHDR(state->png, state->info, size.width, size.height, 8, colourType,
        PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
      png_write_info(state->png, state->info);
    });
  if (!begun)
  {
    return *state->error;
  }
  return std::unique_ptr<PNGWriter>(new PNGWriter(std::move(stream)));
}

Result<void> PNGWriter::append(
  const std::uint8_t* firstRow, std::uint32_t count, std::ptrdiff_t strideBytes)
{
  assert(count <= stream_->rowsToCome);
  assert(!stream_->error);
  png_structp png = stream_->png;
  const bool written = completes(png,
    [&]
    {
      for (std::uint32_t row = 0; row < count; ++row)
      {
        png_write_row(png, firstRow + std::ptrdiff_t(row) * strideBytes);
      }
    });
  if (!written)
  {
    return *stream_->error;
  }
  stream_->rowsToCome -= count;
  return {};
}

Result<void> PNGWriter::finish()
{
  assert(stream_->rowsToCome == 0);
  assert(!stream_->error);
  png_structp png = stream_->png;
  if (!completes(png, [&] { png_write_end(png, nullptr); }))
  {
    return *stream_->error;
  }
  return stream_->file->publish();
}

} // namespace pointfront
