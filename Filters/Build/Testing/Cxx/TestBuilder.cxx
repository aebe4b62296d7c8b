#include "pointfront/Store/PointStore.h"
#include "vtkPointFrontBuilder.h"
#include "vtkPointFrontStore.h"

#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkTestErrorObserver.h>

#include <gtest/gtest.h>

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
  vtkNew<vtkTest::ErrorObserver> errors;
  builder->AddObserver(vtkCommand::ErrorEvent, errors);
  builder->AddFileName("no/such.las");
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_EQ(builder->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileNotFoundError));
  EXPECT_EQ(errors->CheckErrorMessage("no/such.las"), 0);

  builder->ClearFileNames();
  errors->Clear();
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_EQ(builder->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoFileNameError));
  EXPECT_TRUE(errors->GetError());

  std::ofstream(builder->GetOutputFileName()) << "mine";
  builder->AddFileName(stadium.c_str());
  errors->Clear();
  EXPECT_EQ(builder->Write(), 0);
  EXPECT_EQ(errors->CheckErrorMessage("exists already"), 0);
  builder->OverwriteOn();
  EXPECT_EQ(builder->Write(), 1);
}

} // namespace
