#include "ErrorObserver.h"

#include "pointfront/Store/PointStore.h"
#include "vtkPointFrontBuilder.h"

#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include <unistd.h>

namespace
{

namespace fs = std::filesystem;

class PointSets : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = fs::path(testing::TempDir()) / ("pointfront-pointsets-" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    path = (folder / "a.pfront").string();
    builder->SetPoints(data);
    builder->SetOutputFileName(path.c_str());
    builder->OverwriteOn();
    builder->PreviewOff();
    builder->AddObserver(vtkCommand::ErrorEvent, errors);
    builder->AddObserver(vtkCommand::WarningEvent, errors);
  }
  void TearDown() override { fs::remove_all(folder); }

  /// Points (i, 0, 0).
  void setRow(int count)
  {
    vtkNew<vtkPoints> points;
    for (int i = 0; i < count; ++i)
    {
      points->InsertNextPoint(i, 0.0, 0.0);
    }
    data->SetPoints(points);
  }
  void addArray(const char* name, int tuples)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(tuples);
    array->Fill(0.0);
    data->GetPointData()->AddArray(array);
  }
  std::string warnings() const { return errors->GetWarning() ? errors->GetWarningMessage() : ""; }
  std::shared_ptr<const pointfront::PointStore> store() const
  {
    const auto opened = pointfront::PointStore::open(path);
    return opened ? *opened : nullptr;
  }

  fs::path folder;
  std::string path;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPointFrontBuilder> builder;
  vtkNew<ErrorObserver> errors;
};

TEST_F(PointSets, AnArrayOfFewerTuplesThanPointsIsAnError)
{
  for (const char* name : { "temperature", "elevation" })
  {
    data->GetPointData()->Initialize();
    setRow(70000);
    addArray(name, 10);
    errors->Clear();
    EXPECT_EQ(builder->Write(), 0) << name;
    EXPECT_NE(builder->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    const std::string said = errors->GetErrorMessage();
    EXPECT_NE(said.find(std::string("\"") + name + "\""), std::string::npos) << said;
    EXPECT_NE(said.find("10 tuples"), std::string::npos) << said;
    EXPECT_NE(said.find("70000 points"), std::string::npos) << said;
    EXPECT_TRUE(fs::is_empty(folder));
  }
}

TEST_F(PointSets, OfAnArrayOfMoreTuplesThanPointsTheFirstAreStored)
{
  setRow(10);
  addArray("elevation", 70000);
  ASSERT_EQ(builder->Write(), 1);
  EXPECT_NE(warnings().find("\"elevation\" has 70000 tuples"), std::string::npos) << warnings();
  EXPECT_EQ(store()->description().pointCount, 10u);
  EXPECT_TRUE(store()->description().schema.find("elevation"));
}

} // namespace
