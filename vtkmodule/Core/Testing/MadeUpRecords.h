#pragma once

#include "pointfront/InPlace/GridRecords.h"

#include <cstring>
#include <random>
#include <vector>

namespace pointfront
{

/// Records of 20 bytes in memory, as a scanner might have written them.
class MadeUpRecords
{
public:
  void add(int x, int y, int z)
  {
    const std::int32_t p[3] = { x, y, z };
    bytes_.resize(bytes_.size() + stride);
    std::memcpy(bytes_.data() + bytes_.size() - stride, p, sizeof p);
  }
  GridRecords view() const { return { bytes_.data(), stride, bytes_.size() / stride, 227 }; }
  RecordBox box() const { return boxOf(view(), 0, view().count); }

  /// Flight strips that overlap, each of scan lines across the flight, with noise.
  static MadeUpRecords strips(int points, unsigned seed)
  {
    std::mt19937 random(seed);
    MadeUpRecords records;
    const int perLine = 400;
    for (int i = 0; i < points; ++i)
    {
      const int line = i / perLine;
      const int strip = line / 100;
      const int across = line % 2 == 0 ? i % perLine : perLine - 1 - i % perLine;
      const int noise = static_cast<int>(random() % 40) - 20;
      records.add(strip * 3000 + across * 10 + noise, (line % 100) * 30 + noise / 2,
        static_cast<int>(random() % 200) - 100);
    }
    return records;
  }
  /// The same square, in no order at all.
  static MadeUpRecords scattered(int points, unsigned seed)
  {
    std::mt19937 random(seed);
    MadeUpRecords records;
    for (int i = 0; i < points; ++i)
    {
      const int x = static_cast<int>(random() % 10000) - 5000;
      const int y = static_cast<int>(random() % 10000) - 5000;
      records.add(x, y, static_cast<int>(random() % 100));
    }
    return records;
  }
  MadeUpRecords doubled() const
  {
    MadeUpRecords twice = *this;
    twice.bytes_.insert(twice.bytes_.end(), bytes_.begin(), bytes_.end());
    return twice;
  }

private:
  static constexpr std::size_t stride = 20;
  std::vector<std::byte> bytes_;
};

} // namespace pointfront
