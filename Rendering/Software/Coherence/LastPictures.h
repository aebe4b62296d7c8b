#pragma once

#include "LastPicture.h"

#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

namespace pointfront
{

/// The last pictures of stores, of each of the parts that their pictures are put together of.
class LastPictures
{
public:
  /// A picture begins with part 0: parts that the one before did not have are forgotten then.
  LastPicture& of(std::uint16_t store, std::uint16_t part)
  {
    for (auto each = all_.begin(); part == 0 && each != all_.end();)
    {
      const bool own = (each->first & 0xffffu) == store;
      const bool over = own && !std::exchange(each->second.drawn, false);
      each = over ? all_.erase(each) : std::next(each);
    }
    Last& last = all_[std::uint32_t(part) << 16 | store];
    last.drawn = true;
    return last.picture;
  }
  /// Whether there is a last picture with that number: part << 16 | store.
  bool has(std::uint32_t number) const { return all_.count(number) > 0; }
  /// Pixels of the keys that are kept.
  std::int64_t keyPixels() const
  {
    std::int64_t pixels = 0;
    for (const auto& [number, last] : all_)
    {
      pixels += last.picture.keyPixels();
    }
    return pixels;
  }

private:
  struct Last
  {
    LastPicture picture;
    bool drawn = false; ///< since the last part 0 of its store
  };
  std::map<std::uint32_t, Last> all_; ///< by part and store
};

} // namespace pointfront
