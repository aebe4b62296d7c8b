#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

struct MetadataRecord;

/// The GeoTIFF keys that name a coordinate reference system: in a GeoTIFF image three tags, in a
/// LAS file three records of the same numbers. Parsed, not interpreted: CoordinateSystems knows
/// what a code means.
/// Source   OGC GeoTIFF 1.1, sections 7.1 and 7.4.
class GeoKeys
{
public:
  /// Tags of a TIFF, record ids of owner "LASF_Projection" in LAS.
  static constexpr std::uint16_t directoryTag = 34735;
  static constexpr std::uint16_t doublesTag = 34736;
  static constexpr std::uint16_t textTag = 34737;

  enum Key : std::uint16_t
  {
    ModelType = 1024,
    RasterType = 1025,
    Citation = 1026,
    GeodeticSystem = 2048,
    ProjectedSystem = 3072,
    ProjectedCitation = 3073,
    LinearUnit = 3076,
    VerticalSystem = 4096,
    VerticalUnit = 4099
  };
  static constexpr std::uint16_t userDefined = 32767;

  /// `directory` as it stands in the file; entries that point outside of `text` are left out, as
  /// are those that no complete entry is there for: a damaged directory gives fewer keys.
  static GeoKeys parse(const std::vector<std::uint16_t>& directory, const std::string& text);
  /// From the records of a LAS file; empty when there are none.
  static GeoKeys parse(const std::vector<MetadataRecord>& records);

  bool empty() const { return codes_.empty() && texts_.empty(); }
  /// The value of a key that holds a code; nothing when it is absent.
  std::optional<std::uint16_t> code(Key key) const;
  /// The value of a key that holds text, "" when it is absent.
  std::string text(Key key) const;
  /// RasterPixelIsPoint: a tie point names the centre of its pixel, not its upper left corner.
  bool pixelIsPoint() const { return code(RasterType) == std::uint16_t(2); }

private:
  std::map<std::uint16_t, std::uint16_t> codes_;
  std::map<std::uint16_t, std::string> texts_;
};

} // namespace pointfront
