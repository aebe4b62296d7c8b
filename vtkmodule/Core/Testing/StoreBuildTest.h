#pragma once

#include "TestBuildClouds.h"

#include "pointfront/Store/PointStore.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

namespace pointfront::test
{

/// Builds made-up clouds in a folder of the test's own, with two threads; tests choose the rest.
class StoreBuildTest : public testing::Test
{
protected:
  void SetUp() override
  {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = freshFolder(std::string(test.test_suite_name()) + "-" + test.name());
    options_.outputPath = (folder_ / "cloud.pfront").string();
    options_.threads = 2;
    options_.overwrite = true;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A store that verifies.
  std::shared_ptr<const PointStore> build(std::unique_ptr<CloudSource> cloud)
  {
    const auto report = buildStore(one(std::move(cloud)), options_);
    EXPECT_TRUE(report) << report.error().what;
    const auto store = PointStore::open(options_.outputPath);
    EXPECT_TRUE(store) << store.error().what;
    const auto verified = (*store)->verify();
    EXPECT_TRUE(verified && verified->ok)
      << (verified ? verified->firstError : verified.error().what);
    return *store;
  }
  std::string bytes() const
  {
    std::ifstream file(options_.outputPath, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  }

  std::filesystem::path folder_;
  BuildOptions options_;
};

} // namespace pointfront::test
