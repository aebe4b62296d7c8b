#include "ErrorObserver.h"
#include "pointfront/Store/PointStore.h"
#include "vtkPointFrontBuilder.h"
#include "vtkPointFrontStore.h"

#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include <unistd.h>

namespace
{

namespace fs = std::filesystem;
const std::string stadium = POINTFRONT_TEST_DATA "/autzen_stadium.laz";

class Builder : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = fs::path(testing::TempDir()) / ("pointfront-builder-" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    builder->AddFileName(stadium.c_str());
    builder->SetOutputFileName((folder / "stadium.pfront").c_str());
    builder->SetMemoryLimit(vtkTypeInt64(1) << 30);
  }
  void TearDown() override { fs::remove_all(folder); }

  void on(unsigned long event, std::function<void()> action)
  {
    actions.push_back(std::make_unique<std::function<void()>>(std::move(action)));
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(actions.back().get());
    command->SetCallback([](vtkObject*, unsigned long, void* data, void*)
      { (*static_cast<std::function<void()>*>(data))(); });
    builder->AddObserver(event, command);
  }
  std::size_t entries() const
  {
    return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  fs::path folder;
  vtkNew<vtkPointFrontBuilder> builder;
  std::vector<std::unique_ptr<std::function<void()>>> actions;
};

TEST_F(Builder, TakesThePointsInABox)
{
  ASSERT_EQ(builder->Write(), 1);
  const vtkIdType all = builder->GetNumberOfPointsStored();
  const auto whole = pointfront::PointStore::open(builder->GetOutputFileName());
  ASSERT_TRUE(whole);
  const pointfront::Bounds bounds = whole.value()->description().bounds;
  builder->OverwriteOn();
  builder->UseBoxOn();
  builder->SetBox(
    bounds.low.x, bounds.centre().x, bounds.low.y, bounds.high.y, bounds.low.z, bounds.high.z);
  ASSERT_EQ(builder->Write(), 1);
  EXPECT_GT(builder->GetNumberOfPointsStored(), all / 10);
  EXPECT_LT(builder->GetNumberOfPointsStored(), all);
  EXPECT_EQ(builder->GetNumberOfPointsOutside(), all - builder->GetNumberOfPointsStored());
  EXPECT_EQ(builder->GetNumberOfPointsRejected(), 0);
  vtkNew<ErrorObserver> errors;
  builder->AddObserver(vtkCommand::ErrorEvent, errors);
  builder->SetBox(1, 0, 0, 1, 0, 1);
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_NE(errors->GetErrorMessage().find("is not a box"), std::string::npos);
}

TEST_F(Builder, WritesAStoreAndTellsHowItGetsOn)
{
  const std::thread::id here = std::this_thread::get_id();
  std::vector<double> fractions;
  int begun = 0;
  int ended = 0;
  on(vtkCommand::StartEvent, [&] { ++begun; });
  on(vtkCommand::EndEvent, [&] { ++ended; });
  on(vtkCommand::ProgressEvent,
    [&]
    {
      EXPECT_EQ(std::this_thread::get_id(), here);
      EXPECT_GE(builder->GetPointsTotal(), builder->GetPointsDone());
      fractions.push_back(builder->GetProgress());
    });
  ASSERT_EQ(builder->Write(), 1);
  EXPECT_EQ(builder->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(ended, 1);
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
  const auto store = pointfront::PointStore::open(builder->GetOutputFileName());
  ASSERT_TRUE(store);
  const pointfront::StoreDescription& description = store.value()->description();
  EXPECT_EQ(builder->GetNumberOfPointsStored(), vtkIdType(description.pointCount));
  EXPECT_EQ(builder->GetBytesWritten(), vtkTypeInt64(description.fileBytes));
  EXPECT_GT(builder->GetNumberOfNodes(), 1);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Builder, SaysWhenAPreviewCanBeOpened)
{
  builder->SetPreviewPoints(1000);
  int previews = 0;
  on(vtkCommand::UpdateDataEvent,
    [&]
    {
      vtkStdString error;
      const auto early = vtkPointFrontStore::Open(builder->GetPreviewFileName(), error);
      ASSERT_NE(early, nullptr) << error;
      EXPECT_GT(early->GetNumberOfPoints(), 1000);
      ++previews;
    });
  ASSERT_EQ(builder->Write(), 1);
  EXPECT_GE(previews, 1);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Builder, AnAbortLeavesNothing)
{
  on(vtkCommand::ProgressEvent, [&] { builder->AbortExecuteOn(); });
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_EQ(builder->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::UserError));
  EXPECT_EQ(entries(), 0u);
}

TEST_F(Builder, NamesWhatIsWrong)
{
  vtkNew<ErrorObserver> errors;
  builder->AddObserver(vtkCommand::ErrorEvent, errors);
  builder->AddFileName("no/such.las");
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_EQ(builder->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileNotFoundError));
  EXPECT_NE(errors->GetErrorMessage().find("no/such.las"), std::string::npos);

  builder->ClearFileNames();
  errors->Clear();
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_EQ(builder->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoFileNameError));
  EXPECT_TRUE(errors->GetError());

  builder->AddFileName(stadium.c_str());
  EXPECT_EQ(builder->Write(), 1);
  errors->Clear();
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_NE(errors->GetErrorMessage().find("exists already"), std::string::npos);
  builder->OverwriteOn();
  EXPECT_EQ(builder->Write(), 1);
}

TEST_F(Builder, TellsOfPointsAndFilesThatAreLeftOut)
{
  const fs::path text = folder / "some.xyz";
  std::ofstream(text) << "1 2 3\nnan 2 3\n4 5 6\ninf 0 0\n7 8 9\n";
  const fs::path none = folder / "none.xyz";
  std::ofstream(none) << "nan nan nan\nnan nan nan\n";
  const fs::path broken = folder / "broken.las";
  std::ofstream(broken) << "LASF and no more";
  builder->ClearFileNames();
  for (const fs::path& file : { text, none, broken })
  {
    builder->AddFileName(file.c_str());
  }
  vtkNew<ErrorObserver> said;
  builder->AddObserver(vtkCommand::ErrorEvent, said);
  builder->AddObserver(vtkCommand::WarningEvent, said);
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_NE(said->GetErrorMessage().find("broken.las"), std::string::npos);
  builder->SkipFaultyFilesOn();
  EXPECT_EQ(builder->Write(), 1);
  EXPECT_EQ(builder->GetNumberOfPointsRead(), 7);
  EXPECT_EQ(builder->GetNumberOfPointsStored(), 3);
  EXPECT_EQ(builder->GetNumberOfPointsRejected(), 4);
  EXPECT_EQ(builder->GetNumberOfFilesSkipped(), 2);
}

TEST_F(Builder, ReplacesStoresOnlyAndNeverWhatItReads)
{
  vtkNew<ErrorObserver> errors;
  builder->AddObserver(vtkCommand::ErrorEvent, errors);
  builder->OverwriteOn();
  std::ofstream(builder->GetOutputFileName()) << "mine";
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_NE(errors->GetErrorMessage().find("text file"), std::string::npos);
  const fs::path copy = folder / "copy.laz";
  fs::copy_file(stadium, copy);
  fs::remove(builder->GetOutputFileName());
  fs::create_hard_link(copy, builder->GetOutputFileName());
  builder->ClearFileNames();
  builder->AddFileName(copy.c_str());
  errors->Clear();
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_NE(errors->GetErrorMessage().find("which is read"), std::string::npos);
  EXPECT_EQ(fs::file_size(copy), fs::file_size(stadium));
}

TEST_F(Builder, GivesTheStoreTheShapeAndTheAttributesThatAreAskedFor)
{
  builder->SetStructureToKdTree();
  builder->SetLayersToNone();
  builder->AddAttribute("intensity");
  builder->AddAttribute("normal");
  builder->AddAttribute("curvature");
  builder->AddAttribute("local_height");
  builder->AddAttribute("height_above_ground");
  builder->SetNormalsToPCA();
  builder->SetNormalsNeighbors(8);
  builder->SetNormalsError(1.0);
  builder->CurvatureOn();
  builder->LocalHeightOn();
  builder->HeightAboveGroundOn();
  builder->SetPrecision(0.01);
  ASSERT_EQ(builder->Write(), 1);
  const auto store = pointfront::PointStore::open(builder->GetOutputFileName());
  ASSERT_TRUE(store);
  const pointfront::StoreDescription& description = store.value()->description();
  EXPECT_EQ(description.structure, "kdtree");
  EXPECT_EQ(description.layers.size(), 1u);
  EXPECT_EQ(description.grid.scale.x, 0.01);
  EXPECT_EQ(description.schema.size(), 5u);
  for (const char* name : { "intensity", "normal", "curvature", "local_height" })
  {
    EXPECT_TRUE(description.schema.find(name)) << name;
  }
}

TEST_F(Builder, MeasuresRadiiOfSplatsWhereTheyAreAskedFor)
{
  EXPECT_FALSE(builder->GetSplatRadius());
  for (const bool asked : { false, true })
  {
    builder->SetSplatRadius(asked);
    builder->OverwriteOn();
    ASSERT_EQ(builder->Write(), 1);
    const auto store = pointfront::PointStore::open(builder->GetOutputFileName());
    ASSERT_TRUE(store);
    const pointfront::StoreDescription& description = store.value()->description();
    EXPECT_EQ(bool(description.schema.find("splat_radius")), asked);
    EXPECT_EQ(description.splatRadiusBase > 0.0, asked);
    EXPECT_FALSE(description.schema.find("normal"));
  }
}

TEST_F(Builder, BuildsRepresentativesByClass)
{
  builder->SetRefinementToReplace();
  builder->SetLayersToClass();
  builder->SetNormalsToScanLine();
  builder->AddNormalsClass(2);
  ASSERT_EQ(builder->Write(), 1);
  const auto store = pointfront::PointStore::open(builder->GetOutputFileName());
  ASSERT_TRUE(store);
  const pointfront::StoreDescription& description = store.value()->description();
  EXPECT_EQ(description.refinement, pointfront::Refinement::Replace);
  ASSERT_EQ(description.layers.size(), 1u);
  EXPECT_NE(description.layers[0].name, "all"); // the one class that this file has
  EXPECT_TRUE(description.schema.find("enclosing_radius"));
  EXPECT_TRUE(description.schema.find("normal"));
}

TEST_F(Builder, RefusesWhatDoesNotGoTogether)
{
  vtkNew<ErrorObserver> errors;
  builder->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto refuses = [&](const char* why)
  {
    errors->Clear();
    EXPECT_EQ(builder->Write(), 0) << why;
    EXPECT_NE(builder->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    EXPECT_NE(errors->GetErrorMessage().find(why), std::string::npos);
    EXPECT_EQ(entries(), 0u);
  };
  builder->SetNormalsRadius(2.0);
  refuses("normals by PCA or PCL, which are not asked for");
  builder->SetNormalsToPCA();
  builder->SetNormalsNeighbors(8);
  refuses("not both");
  builder->SetNormalsRadius(0.0);
  builder->SetNormalsNeighbors(2);
  refuses("a number of neighbours of 2");
  builder->SetNormalsNeighbors(16);
  builder->AddNormalsClass(300);
  refuses("class 300");
  builder->ClearNormalsClasses();
  builder->SetNormalsToNone();
  builder->SetColorDepth(12);
  refuses("ColorDepth of 12");
  builder->SetColorDepth(0);
  builder->AddColorImage("no/such.tif");
  refuses("no/such.tif");
  builder->ClearImages();
  builder->SetCRS("EPSG:0");
  refuses("EPSG:0");
}

} // namespace
