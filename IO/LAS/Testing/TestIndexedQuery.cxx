#include "FileBytes.h"
#include "IndexedLASFile.h"
#include "LASIndexing.h"
#include "LASWriter.h"
#include "QueryOracle.h"

#include "pointfront/Export/SourceExport.h"

#include <gtest/gtest.h>

namespace pointfront::test
{

TEST(IndexedLASFile, AnswersQueriesAsABruteForceFilterDoes)
{
  const OracleCloud cloud(6000);
  const std::string las = outputFolder() + "/oracle.las";
  LASWriter writer(las);
  const auto written = exportSource(cloud, writer);
  ASSERT_TRUE(written) << written.error().what;
  LASIndexOptions options;
  options.leafPoints = 100;
  options.overwrite = true;
  const auto indexed = indexLASFile(las, las + lasIndexSuffix, options);
  ASSERT_TRUE(indexed) << indexed.error().what;
  const auto opened = IndexedLASFile::open(las + lasIndexSuffix);
  ASSERT_TRUE(opened) << opened.error().what;
  ASSERT_GT((*opened)->hierarchy()->nodeCount(), 50u);
  expectOracle(**opened, cloud, 1000);
}

} // namespace pointfront::test
