#include "PNGReader.h"

#include "pointfront/Disk/InputFile.h"

#include <csetjmp>
#include <memory>
#include <new>
#include <optional>
#include <png.h>
#include <utility>

namespace pointfront
{
namespace
{
/// Deflate codes at most 258 bytes in two bits; a file cannot hold more than that.
constexpr std::uint64_t mostBytesPerByte = 1032;
constexpr std::size_t signatureBytes = 8;

/// A file that libpng reads from its begin to its end.
class PNGInput
{
public:
  explicit PNGInput(std::unique_ptr<const InputFile> file)
    : file_(std::move(file))
    , png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &onError, &onWarning))
    , info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr)
  {
  }
  ~PNGInput() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PNGInput(const PNGInput&) = delete;
  PNGInput& operator=(const PNGInput&) = delete;

  Result<Picture> read(const PNGLimits& limits);

private:
  /// libpng leaves its functions by longjmp when something is wrong. Nothing with a destructor
  /// may stand between this and its calls: `calls` captures references only.
  template <typename Calls>
  bool completes(const Calls& calls)
  {
    if (setjmp(png_jmpbuf(png_)) != 0)
    {
      return false;
    }
    calls();
    return true;
  }

  Result<void> readHeader();
  Result<void> checkSize(const PNGLimits& limits) const;
  Result<void> readPixels(Picture& picture);

  Error fault(Error::Kind kind, const std::string& text) const
  {
    return makeError(kind, "'" + file_->path() + "': " + text);
  }
  bool take(png_bytep target, std::size_t size);
  void note(const char* reason);

  static void onRead(png_structp png, png_bytep target, png_size_t size)
  {
    if (!static_cast<PNGInput*>(png_get_io_ptr(png))->take(target, size))
    {
      png_error(png, "the file cannot be read");
    }
  }
  static void onError(png_structp png, png_const_charp reason)
  {
    static_cast<PNGInput*>(png_get_error_ptr(png))->note(reason);
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {} // warnings name chunks that are not pixels

  std::unique_ptr<const InputFile> file_;
  std::uint64_t offset_ = 0;
  std::optional<Error> error_; ///< the first one
  png_structp png_;
  png_infop info_;
};

bool PNGInput::take(png_bytep target, std::size_t size)
{
  if (size > file_->bytes() - offset_)
  {
    error_ = fault(Error::Kind::Truncated,
      "the file ends at byte " + std::to_string(file_->bytes()) +
        ", before its picture does; it was cut short, copy or draw it again");
    return false;
  }
  Result<void> done = file_->readAt(offset_, reinterpret_cast<std::byte*>(target), size);
  if (!done)
  {
    error_ = done.error();
    return false;
  }
  offset_ += size;
  return true;
}

void PNGInput::note(const char* reason)
{
  if (!error_)
  {
    error_ = fault(Error::Kind::BadFormat,
      std::string("a damaged PNG file, near byte ") + std::to_string(offset_) + ": " + reason);
  }
}

Result<void> PNGInput::readHeader()
{
  if (info_ == nullptr)
  {
    return fault(Error::Kind::NoMemory, "no memory for libpng");
  }
  png_byte signature[signatureBytes] = {};
  const std::size_t present =
    file_->bytes() < signatureBytes ? std::size_t(file_->bytes()) : signatureBytes;
  if (!take(signature, present))
  {
    return *error_;
  }
  // An empty file begins as a PNG file does.
  if (present != 0 && png_sig_cmp(signature, 0, present) != 0)
  {
    return fault(Error::Kind::BadFormat, "not a PNG file");
  }
  const bool read = completes(
    [&]
    {
      png_set_read_fn(png_, this, &onRead);
      png_set_sig_bytes(png_, int(present));
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // checkSize() has our own
      png_read_info(png_, info_);
    });
  return read ? Result<void>{} : *error_;
}

Result<void> PNGInput::checkSize(const PNGLimits& limits) const
{
  const std::uint64_t width = png_get_image_width(png_, info_);
  const std::uint64_t height = png_get_image_height(png_, info_);
  if (width * height > limits.pixels)
  {
    return fault(Error::Kind::Unsupported,
      std::to_string(width) + " x " + std::to_string(height) + " pixels are more than the " +
        std::to_string(limits.pixels) + " that are read at most");
  }
  // Before the transformations: as the file holds it. Interlacing needs no less.
  const std::uint64_t rawBytes = std::uint64_t(png_get_rowbytes(png_, info_)) * height;
  if (rawBytes / mostBytesPerByte > file_->bytes())
  {
    return fault(Error::Kind::Truncated,
      "the file ends at byte " + std::to_string(file_->bytes()) + ", too early for " +
        std::to_string(width) + " x " + std::to_string(height) +
        " pixels; it was cut short, copy or draw it again");
  }
  return {};
}

Result<void> PNGInput::readPixels(Picture& picture)
{
  const std::size_t rowBytes = std::size_t(4) * picture.width;
  const bool read = completes(
    [&]
    {
      png_set_expand(png_); // palette to RGB, fewer bits to 8, a transparent colour to opacity
      png_set_scale_16(png_);
      png_set_gray_to_rgb(png_);
      png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
      const int passes = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      if (png_get_rowbytes(png_, info_) != rowBytes)
      {
        png_error(png_, "unexpected layout of a row");
      }
      for (int pass = 0; pass < passes; ++pass)
      {
        for (std::uint32_t row = 0; row < picture.height; ++row)
        {
          png_read_row(png_, picture.rgba.data() + rowBytes * row, nullptr);
        }
      }
      png_read_end(png_, nullptr);
    });
  return read ? Result<void>{} : *error_;
}

Result<Picture> PNGInput::read(const PNGLimits& limits)
{
  if (info_ == nullptr)
  {
    return fault(Error::Kind::NoMemory, "no memory for libpng");
  }
  if (Result<void> done = readHeader(); !done)
  {
    return done.error();
  }
  if (Result<void> done = checkSize(limits); !done)
  {
    return done.error();
  }
  Picture picture;
  picture.width = png_get_image_width(png_, info_);
  picture.height = png_get_image_height(png_, info_);
  try
  {
    picture.rgba.resize(4 * picture.pixels());
  }
  catch (const std::bad_alloc&)
  {
    return fault(Error::Kind::NoMemory,
      "no memory for " + std::to_string(4 * picture.pixels()) + " bytes of pixels");
  }
  if (Result<void> done = readPixels(picture); !done)
  {
    return done.error();
  }
  return picture;
}
} // namespace

Result<Picture> readPNG(const std::string& path, const PNGLimits& limits)
{
  Result<std::unique_ptr<const InputFile>> file = InputFile::open(path);
  if (!file)
  {
    return file.error();
  }
  PNGInput input(std::move(*file));
  return input.read(limits);
}

} // namespace pointfront
