#pragma once

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Points/PointSource.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace pointfront::test
{

/// Nodes of so many points: few points make a tree.
inline BuildOptions nodesOf(std::uint32_t points)
{
  BuildOptions options;
  options.nodePoints = points;
  return options;
}

/// Builds a store of one cloud where tests may write, over an older one of that name, by one
/// thread; gives its path. A failure is a test failure.
inline std::string builtStore(
  const std::string& name, std::unique_ptr<PointSource> cloud, BuildOptions options = nodesOf(2000))
{
  options.outputPath = ::testing::TempDir() + name + ".pfront";
  options.overwrite = true;
  options.threads = 1;
  PointSources sources;
  sources.push_back(std::move(cloud));
  const auto built = buildStore(sources, options);
  EXPECT_TRUE(built.ok()) << (built.ok() ? "" : built.error().what);
  return options.outputPath;
}

} // namespace pointfront::test
