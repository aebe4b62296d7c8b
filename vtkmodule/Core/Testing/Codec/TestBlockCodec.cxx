#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/Codec/PackedCodec.h"
#include "pointfront/Codec/PlaneCodec.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <random>

namespace pointfront
{
namespace
{
using Values = std::vector<std::byte>;
using Pattern = std::function<std::uint64_t(std::size_t index, std::mt19937_64& random)>;

struct NamedPattern
{
  const char* name;
  Pattern value;
};

// The patterns use the low bytes of each value.
const std::vector<NamedPattern> patterns{
  { "zero", [](std::size_t, std::mt19937_64&) { return 0; } },
  { "constant", [](std::size_t, std::mt19937_64&) { return 0xfedcba9876543210ull; } },
  { "ramp", [](std::size_t i, std::mt19937_64&) { return i * 37; } },
  { "noise", [](std::size_t, std::mt19937_64& random) { return random(); } },
  { "small steps", [](std::size_t i, std::mt19937_64& random) { return i + random() % 5; } },
  { "rare peaks",
    [](std::size_t i, std::mt19937_64& random)
    { return i % 97 == 5 ? random() : std::uint64_t(1000) + random() % 3; } },
  { "extremes",
    [](std::size_t i, std::mt19937_64&) { return i % 2 == 0 ? 0 : ~std::uint64_t(0); } },
  { "few kinds", [](std::size_t, std::mt19937_64& random) { return random() % 3; } },
  { "common factor", [](std::size_t, std::mt19937_64& random) { return random() % 250 * 257; } },
  { "one differs", [](std::size_t i, std::mt19937_64&) { return i == 1 ? 1 : 0; } },
};

Values makeValues(const BlockShape& shape, const Pattern& pattern)
{
  Values values(shape.bytes());
  std::mt19937_64 random(7);
  for (std::size_t i = 0; i < shape.points * shape.components; ++i)
  {
    const std::uint64_t value = pattern(i, random);
    std::memcpy(values.data() + i * shape.scalarBytes, &value, shape.scalarBytes);
  }
  return values;
}

/// Decodes from and into memory of exactly the right size, so that a sanitizer sees every slip.
bool decodeExactly(BlockCodec codec, const Values& coded, const BlockShape& shape, Values& values)
{
  const Values tight(coded);
  values.assign(shape.bytes(), std::byte(0xcd));
  return decodeBlock(codec, tight.data(), tight.size(), shape, values.data());
}

std::string nameOf(const BlockShape& shape, const char* pattern)
{
  return std::string(pattern) + ", " + std::to_string(shape.points) + " points of " +
    std::to_string(shape.components) + " x " + std::to_string(shape.scalarBytes) + " bytes";
}

template <typename Visit>
void forEveryShape(const std::vector<std::size_t>& counts, const Visit& visit)
{
  for (const std::size_t points : counts)
  {
    for (const unsigned components : { 1u, 2u, 3u, 4u, 16u })
    {
      for (const unsigned scalarBytes : { 1u, 2u, 4u, 8u })
      {
        visit(BlockShape{ points, components, scalarBytes });
      }
    }
  }
}
} // namespace

TEST(BlockCodec, EveryCodecGivesBackEveryBit)
{
  const auto visit = [](const BlockShape& shape)
  {
    for (const NamedPattern& pattern : patterns)
    {
      SCOPED_TRACE(nameOf(shape, pattern.name));
      const Values values = makeValues(shape, pattern.value);
      Values back;
      const CodedBlock chosen = encodeBlock(values.data(), shape);
      ASSERT_TRUE(decodeExactly(chosen.codec, chosen.bytes, shape, back));
      ASSERT_EQ(back, values);
      ASSERT_LE(chosen.bytes.size(), values.size());
      if (shape.points > 0)
      {
        ASSERT_TRUE(
          decodeExactly(BlockCodec::Packed, encodePacked(values.data(), shape), shape, back));
        ASSERT_EQ(back, values);
        ASSERT_TRUE(
          decodeExactly(BlockCodec::PlanesZstd, encodePlanes(values.data(), shape), shape, back));
        ASSERT_EQ(back, values);
      }
    }
  };
  forEveryShape({ 0, 1, 2, 127, 128, 129, 300, 2049 }, visit);
  visit({ 70000, 3, 4 });
  visit({ 70000, 1, 8 });
  visit({ 70000, 3, 1 });
}

TEST(BlockCodec, KeepsThePayloadOfNaN)
{
  const std::uint64_t quiet = 0x7ff8000000000123ull;
  const std::uint64_t signalling = 0xfff0000000000001ull;
  const BlockShape shape{ 300, 1, 8 };
  const Values values = makeValues(
    shape, [&](std::size_t i, std::mt19937_64&) { return i % 3 == 0 ? quiet : signalling; });
  const CodedBlock coded = encodeBlock(values.data(), shape);
  Values back;
  ASSERT_TRUE(decodeExactly(coded.codec, coded.bytes, shape, back));
  EXPECT_EQ(back, values);
}

TEST(BlockCodec, ChoosesByWhatItSaves)
{
  const auto codecOf = [](const BlockShape& shape, const Pattern& pattern)
  { return encodeBlock(makeValues(shape, pattern).data(), shape).codec; };
  EXPECT_EQ(codecOf({ 5000, 3, 4 }, patterns[1].value), BlockCodec::Constant);
  EXPECT_EQ(codecOf({ 5000, 1, 8 }, patterns[3].value), BlockCodec::Raw);
  EXPECT_EQ(codecOf({ 5000, 3, 4 }, patterns[4].value), BlockCodec::Packed);
  // Zstandard is for values that repeat at a distance.
  EXPECT_EQ(codecOf({ 5000, 1, 1 }, [](std::size_t i, std::mt19937_64&) { return i % 50 * 181; }),
    BlockCodec::PlanesZstd);
}

TEST(BlockCodec, ColoursStretchedToSixteenBitsCostNoMore)
{
  const BlockShape narrow{ 4096, 3, 1 };
  const BlockShape wide{ 4096, 3, 2 };
  const Pattern colour = [](std::size_t, std::mt19937_64& random) { return 90 + random() % 32; };
  const Pattern stretched = [](std::size_t, std::mt19937_64& random)
  { return (90 + random() % 32) * 257; };
  const std::size_t small = encodePacked(makeValues(narrow, colour).data(), narrow).size();
  const std::size_t large = encodePacked(makeValues(wide, stretched).data(), wide).size();
  EXPECT_LE(large, small + small / 50);
}

// Whoever forges a checksum can hand any bytes to a decoder. It may give wrong values or refuse;
// it may not touch memory that is not its own (run under the Address Sanitizer).
TEST(BlockCodec, SurvivesForgedBytes)
{
  std::mt19937_64 random(11);
  std::size_t refused = 0;
  const auto visit = [&](const BlockShape& shape)
  {
    for (const BlockCodec codec :
      { BlockCodec::Raw, BlockCodec::Constant, BlockCodec::Packed, BlockCodec::PlanesZstd })
    {
      const Values values = makeValues(shape, patterns[5].value);
      const Values sound = codec == BlockCodec::PlanesZstd ? encodePlanes(values.data(), shape)
                                                           : encodePacked(values.data(), shape);
      Values back;
      for (int round = 0; round < 40; ++round)
      {
        Values forged = sound;
        const std::size_t flips = 1 + random() % 8;
        for (std::size_t f = 0; f < flips; ++f)
        {
          forged[random() % forged.size()] = static_cast<std::byte>(random());
        }
        if (round % 4 == 3)
        {
          forged.resize(random() % (forged.size() + 40));
        }
        refused += decodeExactly(codec, forged, shape, back) ? 0 : 1;
      }
    }
  };
  forEveryShape({ 1, 100, 128, 300 }, visit);
  EXPECT_GT(refused, 1000u);
}

TEST(BlockCodec, RefusesWhatIsTooLongOrTooShort)
{
  const BlockShape shape{ 500, 3, 4 };
  const Values values = makeValues(shape, patterns[5].value);
  Values back;
  for (const BlockCodec codec : { BlockCodec::Packed, BlockCodec::PlanesZstd })
  {
    Values coded = codec == BlockCodec::Packed ? encodePacked(values.data(), shape)
                                               : encodePlanes(values.data(), shape);
    coded.push_back(std::byte(0));
    EXPECT_FALSE(decodeExactly(codec, coded, shape, back));
    coded.resize(coded.size() - 2);
    EXPECT_FALSE(decodeExactly(codec, coded, shape, back));
    EXPECT_FALSE(decodeExactly(codec, {}, shape, back));
  }
  EXPECT_FALSE(decodeExactly(BlockCodec::Raw, Values(5999), shape, back));
  EXPECT_FALSE(decodeExactly(BlockCodec::Constant, Values(11), shape, back));
  EXPECT_FALSE(decodeExactly(static_cast<BlockCodec>(9), Values(6000), shape, back));
}

} // namespace pointfront
