#include "RasterTiles.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <tiffio.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
using OIIO::ImageInput;
using OIIO::ImageSpec;

constexpr int bandRows = 128;
const std::string bytesPrefix = "bytes:";
const std::string elementsPrefix = "elements:";

/// Leaves the colours as they are: OpenImageIO multiplies them by alpha otherwise.
ImageSpec rawConfig()
{
  ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  return config;
}

/// An image whose elements are shown as so many channels of bytes.
class ByteInput final : public ImageInput
{
public:
  static ImageInput* make() { return new ByteInput; }
  const char* format_name() const override { return "bytes"; }
  bool open(const std::string& name, ImageSpec& spec) override
  {
    const ImageSpec config = rawConfig();
    inner_ = ImageInput::open(name.substr(bytesPrefix.size()), &config);
    if (!inner_)
    {
      errorfmt("{}", OIIO::geterror());
      return false;
    }
    m_spec = inner_->spec();
    m_spec.nchannels *= static_cast<int>(m_spec.format.size());
    m_spec.format = OIIO::TypeDesc::UINT8;
    m_spec.alpha_channel = -1;
    m_spec.default_channel_names();
    spec = m_spec;
    return true;
  }
  bool close() override
  {
    inner_.reset();
    return true;
  }
  int current_subimage() const override { return 0; }
  bool read_native_scanline(int, int, int y, int z, void* data) override
  {
    return passedOn(inner_->read_native_scanline(0, 0, y, z, data));
  }
  bool read_native_tile(int, int, int x, int y, int z, void* data) override
  {
    return passedOn(inner_->read_native_tile(0, 0, x, y, z, data));
  }

private:
  bool passedOn(bool done)
  {
    if (!done)
    {
      errorfmt("{}", inner_->geterror());
    }
    return done;
  }
  std::unique_ptr<ImageInput> inner_;
};

int keepError(TIFF*, void* input, const char*, const char* format, va_list arguments)
{
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  static_cast<ImageInput*>(input)->errorfmt("{}", text);
  return 1; // handled: libtiff prints nothing
}

int dropWarning(TIFF*, void*, const char*, const char*, va_list)
{
  return 1;
}

/// The elements of a TIFF as they stand in the file, as so many channels of bytes. For what
/// OpenImageIO does not give: the indices of a palette, grey whose 0 is white, which it inverts if
/// it has 8 bits, and doubles, of which it loses single rows (2.4).
class ElementInput final : public ImageInput
{
public:
  static ImageInput* make() { return new ElementInput; }
  ~ElementInput() override { ElementInput::close(); }
  const char* format_name() const override { return "elements"; }
  bool open(const std::string& name, ImageSpec& spec) override
  {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, &keepError, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, &dropWarning, nullptr);
    tiff_ = TIFFOpenExt(name.substr(elementsPrefix.size()).c_str(), "r", options);
    TIFFOpenOptionsFree(options);
    if (tiff_ == nullptr)
    {
      return false;
    }
    std::uint16_t bits = 1;
    std::uint16_t channels = 1;
    std::uint16_t planes = PLANARCONFIG_CONTIG;
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_SAMPLESPERPIXEL, &channels);
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_PLANARCONFIG, &planes);
    if (bits % 8 != 0 || (planes != PLANARCONFIG_CONTIG && channels > 1))
    {
      errorfmt("{} bits a pixel{} are not read here", bits,
        planes != PLANARCONFIG_CONTIG ? " in separate planes" : "");
      return false;
    }
    m_spec = ImageSpec(number(TIFFTAG_IMAGEWIDTH), number(TIFFTAG_IMAGELENGTH), channels * bits / 8,
      OIIO::TypeDesc::UINT8);
    if (TIFFIsTiled(tiff_) != 0)
    {
      m_spec.tile_width = number(TIFFTAG_TILEWIDTH);
      m_spec.tile_height = number(TIFFTAG_TILELENGTH);
      m_spec.tile_depth = 1;
    }
    spec = m_spec;
    return true;
  }
  bool close() override
  {
    if (tiff_ != nullptr)
    {
      TIFFClose(std::exchange(tiff_, nullptr));
    }
    return true;
  }
  int current_subimage() const override { return 0; }
  bool read_native_scanline(int, int, int y, int, void* data) override
  {
    return TIFFReadScanline(tiff_, data, static_cast<std::uint32_t>(y), 0) == 1;
  }
  bool read_native_tile(int, int, int x, int y, int, void* data) override
  {
    return TIFFReadTile(
             tiff_, data, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0) >= 0;
  }

private:
  int number(std::uint32_t tag) const
  {
    std::uint32_t value = 0;
    TIFFGetField(tiff_, tag, &value);
    return static_cast<int>(value);
  }
  TIFF* tiff_ = nullptr;
};

bool keptByCache(ScalarType type)
{
  return type == ScalarType::UInt8 || type == ScalarType::UInt16 || type == ScalarType::Float32;
}

struct Registered
{
  OIIO::ustring name;
  std::string path;
  OIIO::ImageCache::ImageHandle* handle = nullptr;
  RasterTiles::Layout layout;
};
} // namespace

struct RasterTiles::Cache
{
  OIIO::ImageCache* images = OIIO::ImageCache::create(false);
  std::vector<Registered> files;

  ~Cache() { OIIO::ImageCache::destroy(images, true); }
  Error failure(const std::string& path) const
  {
    return makeError(
      Error::Kind::BadFormat, path + ": the image cannot be read: " + images->geterror());
  }
};

RasterTiles::RasterTiles(std::uint64_t bytes)
  : cache_(std::make_unique<Cache>())
{
  OIIO::ImageCache& images = *cache_->images;
  images.attribute("max_memory_MB", static_cast<float>(static_cast<double>(bytes) / (1 << 20)));
  images.attribute("autotile", bandRows);
  images.attribute("unassociatedalpha", 1);
  images.attribute("deduplicate", 0); // equal pixels at two places are two images
}

RasterTiles::~RasterTiles() = default;

Result<std::uint32_t> RasterTiles::add(const RasterFile& file)
{
  OIIO::ImageCache& images = *cache_->images;
  Registered entry;
  entry.path = file.path;
  const bool asStored = file.use == RasterUse::Values &&
    (file.palette || (file.tiff && file.type == ScalarType::Float64));
  const bool elements = asStored || file.whiteIsZero || !file.colours.empty();
  const bool bytes = !elements && !keptByCache(file.type);
  entry.name = (elements ? elementsPrefix : bytes ? bytesPrefix : std::string()) + file.path;
  if ((elements || bytes) &&
    !images.add_file(entry.name, elements ? &ElementInput::make : &ByteInput::make, nullptr, true))
  {
    return cache_->failure(file.path);
  }
  entry.handle = images.get_image_handle(entry.name);
  ImageSpec spec;
  if (entry.handle == nullptr ||
    !images.get_imagespec(entry.handle, images.get_perthread_info(), spec))
  {
    return cache_->failure(file.path);
  }
  entry.layout.width = std::max(1, spec.tile_width);
  entry.layout.height = std::max(1, spec.tile_height);
  entry.layout.across = (spec.width + entry.layout.width - 1) / entry.layout.width;
  cache_->files.push_back(entry);
  return static_cast<std::uint32_t>(cache_->files.size() - 1);
}

const RasterTiles::Layout& RasterTiles::layout(std::uint32_t image) const
{
  return cache_->files[image].layout;
}

Result<RasterTiles::Tile> RasterTiles::tile(std::uint32_t image, int column, int row) const
{
  OIIO::ImageCache& images = *cache_->images;
  const Registered& file = cache_->files[image];
  OIIO::ImageCache::Tile* tile =
    images.get_tile(file.handle, images.get_perthread_info(), 0, 0, column, row, 0);
  OIIO::TypeDesc format;
  const void* pixels = tile != nullptr ? images.tile_pixels(tile, format) : nullptr;
  if (pixels == nullptr || images.has_error()) // this thread's errors; a tile may come all the same
  {
    if (tile != nullptr)
    {
      images.release_tile(tile);
    }
    return cache_->failure(file.path);
  }
  return Tile(*this, tile, static_cast<const std::byte*>(pixels));
}

RasterTiles::Tile::Tile(Tile&& other) noexcept
  : tiles_(other.tiles_)
  , handle_(std::exchange(other.handle_, nullptr))
  , pixels_(other.pixels_)
{
}

RasterTiles::Tile::~Tile()
{
  if (handle_ != nullptr)
  {
    tiles_->cache_->images->release_tile(static_cast<OIIO::ImageCache::Tile*>(handle_));
  }
}

std::uint64_t RasterTiles::tilesRead() const
{
  int count = 0; // asked for as 64 bits, it is not given
  cache_->images->getattribute("stat:tiles_created", OIIO::TypeDesc::INT32, &count);
  return static_cast<std::uint64_t>(count);
}

std::uint64_t RasterTiles::bytesUsed() const
{
  long long bytes = 0;
  cache_->images->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
  return static_cast<std::uint64_t>(bytes);
}

} // namespace pointfront
