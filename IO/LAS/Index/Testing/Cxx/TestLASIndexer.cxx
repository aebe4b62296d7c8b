#include "vtkPointFrontLASIndexer.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;

/// A folder with a copy of a public LAS file; goes with the test.
class LASIndexer : public testing::Test
{
protected:
  void SetUp() override
  {
    folder_ = testing::TempDir() + "pointfront-indexer-" + std::to_string(::getpid());
    fs::create_directories(folder_);
    las_ = folder_ + "/points.las";
    fs::copy_file(POINTFRONT_SHARED_DATA "/las/real/autzen_trim.las", las_,
      fs::copy_options::overwrite_existing);
    indexer_->SetFileName(las_.c_str());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string folder_;
  std::string las_;
  vtkNew<vtkPointFrontLASIndexer> indexer_;
};

TEST_F(LASIndexer, WhatItWritesIsReadAsAStore)
{
  ASSERT_TRUE(indexer_->Index());
  EXPECT_EQ(indexer_->GetNumberOfPoints(), 110000);
  const std::string side = las_ + ".pfindex";
  EXPECT_EQ(vtkPointFrontReader::CanReadFile(side.c_str()), 1);
  EXPECT_EQ(vtkPointFrontReader::CanReadFile(las_.c_str()), 0);

  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(side.c_str());
  reader->SetOverviewPoints(5000);
  reader->Update();
  vtkPolyData* overview = reader->GetOutput();
  EXPECT_GT(overview->GetNumberOfPoints(), 1000);
  EXPECT_LE(overview->GetNumberOfPoints(), 5000);
  EXPECT_NE(overview->GetPointData()->GetArray("rgb"), nullptr);
  ASSERT_NE(reader->GetStore(), nullptr);
  EXPECT_EQ(reader->GetStore()->GetNumberOfPoints(), 110000);
  double bounds[6];
  reader->GetStore()->GetBounds(bounds);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_LE(bounds[2 * axis], overview->GetBounds()[2 * axis]);
    EXPECT_GE(bounds[2 * axis + 1], overview->GetBounds()[2 * axis + 1]);
  }
}

TEST_F(LASIndexer, ReplacesAnIndexOnlyWhenItMay)
{
  ASSERT_TRUE(indexer_->Index());
  vtkNew<vtkCallbackCommand> silent; // or errors go to the window
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  indexer_->AddObserver(vtkCommand::ErrorEvent, silent);
  EXPECT_FALSE(indexer_->Index());
  indexer_->OverwriteOn();
  EXPECT_TRUE(indexer_->Index());
  indexer_->SetIndexFileName(las_.c_str());
  const auto bytes = fs::file_size(las_);
  EXPECT_FALSE(indexer_->Index());
  EXPECT_EQ(fs::file_size(las_), bytes);
}

TEST_F(LASIndexer, WritesWhereItIsTold)
{
  const std::string side = folder_ + "/other.pfindex";
  indexer_->SetIndexFileName(side.c_str());
  ASSERT_TRUE(indexer_->Index());
  EXPECT_TRUE(fs::exists(side));
  EXPECT_FALSE(fs::exists(las_ + ".pfindex"));
}

TEST_F(LASIndexer, ErrorsAreReportedOnce)
{
  int errors = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&errors);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  indexer_->AddObserver(vtkCommand::ErrorEvent, counter);
  indexer_->SetFileName((las_ + ".none").c_str());
  EXPECT_FALSE(indexer_->Index());
  EXPECT_EQ(errors, 1);
  indexer_->SetFileName(nullptr);
  EXPECT_FALSE(indexer_->Index());
  EXPECT_EQ(errors, 2);
}

TEST_F(LASIndexer, AnObserverCanAbort)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkPointFrontLASIndexer*>(caller)->SetAbort(true); });
  indexer_->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_FALSE(indexer_->Index());
  EXPECT_FALSE(fs::exists(las_ + ".pfindex"));
}

TEST_F(LASIndexer, LoadingItOpensTreesOfOthersAndFolders)
{
  int warnings = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&warnings);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  const auto pointsOf = [&](const std::string& path)
  {
    EXPECT_EQ(vtkPointFrontReader::CanReadFile(path.c_str()), 1) << path;
    vtkNew<vtkPointFrontReader> reader;
    reader->AddObserver(vtkCommand::WarningEvent, counter);
    reader->SetFileName(path.c_str());
    reader->SetOverviewPoints(1000);
    reader->Update();
    EXPECT_GT(reader->GetOutput()->GetNumberOfPoints(), 0) << path;
    return reader->GetStore() ? reader->GetStore()->GetNumberOfPoints() : 0;
  };
  EXPECT_EQ(pointsOf(POINTFRONT_SHARED_DATA "/copc/1.2-with-color.copc.laz"), 1065);
  EXPECT_EQ(pointsOf(POINTFRONT_SHARED_DATA "/ept/lone-star-laszip/ept.json"), 518862);
  EXPECT_EQ(warnings, 0);
  EXPECT_EQ(pointsOf(folder_), 3); // a LAS file of 110,000 points at a glance
  EXPECT_EQ(warnings, 1);
}
} // namespace
