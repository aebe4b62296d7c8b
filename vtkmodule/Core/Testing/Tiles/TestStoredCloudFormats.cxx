#include "pointfront/Tiles/StoredCloudFormats.h"

#include "SampleStore.h"

#include <gtest/gtest.h>

namespace pointfront
{
namespace
{
/// Accepts every file whose path ends in ".foreign" and opens none.
class ForeignKind final : public StoredCloudFormat
{
public:
  explicit ForeignKind(std::string answer)
    : answer_(std::move(answer))
  {
  }
  std::string name() const override { return "foreign"; }
  bool accepts(const std::string& path) const override
  {
    return path.size() > 8 && path.compare(path.size() - 8, 8, ".foreign") == 0;
  }
  Result<std::shared_ptr<const StoredCloud>> open(const std::string&) const override
  {
    return makeError(Error::Kind::Unsupported, answer_);
  }

private:
  std::string answer_;
};

TEST(StoredCloudFormats, OpensStoresFromTheBeginning)
{
  const std::string path = temporaryPath("a.pfront");
  writeSample(makeSample(10), path);
  const StoredCloudFormats formats;
  EXPECT_TRUE(formats.accepts(path));
  const auto cloud = formats.open(path);
  ASSERT_TRUE(cloud);
  EXPECT_EQ((*cloud)->description().pointCount, 60u);
}

TEST(StoredCloudFormats, AsksTheKindThatAcceptsTheFile)
{
  StoredCloudFormats formats;
  formats.add(std::make_shared<ForeignKind>("first"));
  formats.add(std::make_shared<ForeignKind>("second")); // replaces the one of that name
  EXPECT_TRUE(formats.accepts("cloud.foreign"));
  EXPECT_EQ(formats.open("cloud.foreign").error().what, "second");
}

TEST(StoredCloudFormats, WhatNobodyAcceptsIsNotAStore)
{
  const std::string path = temporaryPath("a.pfront");
  writeFile(path, std::vector<std::byte>(100));
  const StoredCloudFormats formats;
  EXPECT_FALSE(formats.accepts(path));
  const auto cloud = formats.open(path);
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().kind, Error::Kind::BadFormat);
  EXPECT_FALSE(formats.accepts(path + ".not-there"));
  EXPECT_EQ(formats.open(path + ".not-there").error().kind, Error::Kind::NotFound);
}
} // namespace
} // namespace pointfront
