#include "SystemName.h"

#include <gtest/gtest.h>

using pointfront::GeoKeys;
using pointfront::systemName;

TEST(SystemName, CodeAndNameStandForTheText)
{
  EXPECT_EQ(
    systemName("PROJCS[\"RGF93 / Lambert-93\",GEOGCS[\"RGF93\",AUTHORITY[\"EPSG\",\"4171\"]],"
               "UNIT[\"metre\",1,AUTHORITY[\"EPSG\",\"9001\"]],AUTHORITY[\"EPSG\",\"2154\"]]"),
    "EPSG:2154 (RGF93 / Lambert-93)");
  EXPECT_EQ(
    systemName("PROJCRS[\"WGS 84 / UTM zone 32N\",BASEGEOGCRS[\"WGS 84\",ID[\"EPSG\",4326]],"
               "CS[Cartesian,2],ID[\"EPSG\",32632]]"),
    "EPSG:32632 (WGS 84 / UTM zone 32N)");
}

TEST(SystemName, CompoundOnesHaveTheCodesOfTheirParts)
{
  EXPECT_EQ(systemName("COMPD_CS[\"here\",PROJCS[\"a\",AUTHORITY[\"EPSG\",\"2154\"]],"
                       "VERT_CS[\"b\",AUTHORITY[\"EPSG\",\"5720\"]]]"),
    "EPSG:2154 + EPSG:5720 (here)");
  EXPECT_EQ(systemName("COMPD_CS[\"here\",PROJCS[\"a\",AUTHORITY[\"EPSG\",\"2154\"]],"
                       "VERT_CS[\"b\",UNIT[\"metre\",1]],AUTHORITY[\"EPSG\",\"7\"]]"),
    "EPSG:7 (here)");
}

TEST(SystemName, GeoTIFFKeysHaveTheirCodesAndCitation)
{
  const auto keysOf = [](const std::vector<std::uint16_t>& entries, const std::string& text)
  {
    std::vector<std::uint16_t> directory{ 1, 1, 0, static_cast<std::uint16_t>(entries.size() / 4) };
    directory.insert(directory.end(), entries.begin(), entries.end());
    return GeoKeys::parse(directory, text);
  };
  constexpr std::uint16_t text = GeoKeys::textTag;
  EXPECT_EQ(systemName(keysOf({ 1024, 0, 1, 1, 3072, 0, 1, 2154, 3073, text, 6, 0 }, "French|")),
    "EPSG:2154 (French)");
  EXPECT_EQ(
    systemName(keysOf({ 3072, 0, 1, 2154, 4096, 0, 1, 5720 }, "")), "EPSG:2154 + EPSG:5720");
  EXPECT_EQ(systemName(keysOf({ 2048, 0, 1, 4326 }, "")), "EPSG:4326");
  EXPECT_EQ(systemName(keysOf({ 1026, text, 5, 0, 3072, 0, 1, 32767 }, "mine|")),
    "mine (GeoTIFF keys without a code)");
  EXPECT_EQ(systemName(keysOf({ 1024, 0, 1, 1 }, "")), "GeoTIFF keys without a code");
}

TEST(SystemName, WhatHasNoCodeKeepsItsName)
{
  EXPECT_EQ(systemName("LOCAL_CS[\"site grid\",UNIT[\"metre\",1]]"), "site grid");
  for (const char* text : { "", "EPSG:2154", "PROJCS[\"cut", "PROJCS[", "PROJCS[]", "[\"x\"]" })
  {
    EXPECT_EQ(systemName(text), text);
  }
  EXPECT_EQ(systemName(std::string(100000, 'A')), std::string(100000, 'A'));
  std::string deep;
  for (int i = 0; i < 100000; ++i)
  {
    deep += "A[";
  }
  EXPECT_EQ(systemName(deep), deep);
}
