#include "ErrorObserver.h"

#include "pointfront/Store/PointStore.h"
#include "vtkPointFrontBuilder.h"
#include "vtkPointFrontStore.h"

#include <vtkCommand.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
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
  /// The distinct positions in the store.
  std::size_t places() const
  {
    std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> found;
    const auto opened = store();
    for (pointfront::NodeIndex node = 0; opened && node < opened->hierarchy()->nodeCount(); ++node)
    {
      const auto columns = opened->read(node, {});
      for (std::size_t i = 0; columns && i < columns->size(); ++i)
      {
        const auto steps = columns->origin + pointfront::GridPosition(columns->positions[i]);
        found.insert({ steps.x, steps.y, steps.z });
      }
    }
    return found.size();
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

/// The build decided on steps of 0.001, whatever the points were: 27 places of 20,000 were left of
/// the smallest of these, and the largest was refused.
TEST_F(PointSets, PointsOfAnySizeStayApart)
{
  constexpr int count = 5000;
  for (const double size : { 0.002, 0.1, 1000.0, 1e8, 1e13 })
  {
    for (const int type : { VTK_FLOAT, VTK_DOUBLE })
    {
      std::mt19937 random(1);
      std::uniform_real_distribution<double> along(0.0, size);
      vtkNew<vtkPoints> points;
      points->SetDataType(type);
      std::set<std::tuple<double, double, double>> given;
      for (int i = 0; i < count; ++i)
      {
        points->InsertNextPoint(along(random), along(random), along(random));
        double place[3];
        points->GetPoint(i, place);
        given.insert({ place[0], place[1], place[2] });
      }
      data->SetPoints(points);
      errors->Clear();
      ASSERT_EQ(builder->Write(), 1) << size << errors->GetErrorMessage();
      EXPECT_EQ(places(), given.size()) << size;
      EXPECT_LE(store()->description().grid.scale.x, 1.01e-6 * size) << size;
    }
  }
}

TEST_F(PointSets, DecimalCoordinatesAreNotRounded)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(type);
    for (int i = 0; i < 2000; ++i)
    {
      points->InsertNextPoint(2e-5 * i, 0.07, 1e-5 * (i % 7));
    }
    data->SetPoints(points);
    errors->Clear();
    ASSERT_EQ(builder->Write(), 1);
    EXPECT_EQ(store()->description().grid.scale.x, 1e-5);
    EXPECT_EQ(warnings().find("rounded"), std::string::npos) << warnings();
    builder->SetPrecision(0.001);
    ASSERT_EQ(builder->Write(), 1);
    EXPECT_EQ(store()->description().grid.scale.x, 0.001);
    builder->SetPrecision(0.0);
  }
}

TEST_F(PointSets, BoundsOfAnEmptyStoreAreThoseOfVTK)
{
  data->SetPoints(vtkNew<vtkPoints>());
  ASSERT_EQ(builder->Write(), 1);
  vtkStdString error;
  const auto empty = vtkPointFrontStore::Open(path.c_str(), error);
  ASSERT_NE(empty, nullptr) << error;
  double bounds[6];
  empty->GetBounds(bounds);
  EXPECT_FALSE(vtkMath::AreBoundsInitialized(bounds));
  for (int end = 0; end < 6; ++end)
  {
    EXPECT_EQ(bounds[end], end % 2 == 0 ? 1.0 : -1.0);
  }
}

TEST_F(PointSets, MarkedPointsAreLeftOutAndCounted)
{
  setRow(70000);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("number");
  vtkNew<vtkUnsignedCharArray> marks;
  marks->SetName(vtkDataSetAttributes::GhostArrayName());
  for (int i = 0; i < 70000; ++i)
  {
    numbers->InsertNextValue(i);
    marks->InsertNextValue(i % 10 == 3 ? vtkDataSetAttributes::DUPLICATEPOINT
        : i % 10 == 7                  ? vtkDataSetAttributes::HIDDENPOINT
                                       : 0);
  }
  data->GetPointData()->AddArray(numbers);
  data->GetPointData()->AddArray(marks);
  ASSERT_EQ(builder->Write(), 1);
  EXPECT_NE(warnings().find("14000 of 70000 points"), std::string::npos) << warnings();
  const auto opened = store();
  ASSERT_EQ(opened->description().pointCount, 56000u);
  std::size_t seen = 0;
  for (pointfront::NodeIndex node = 0; node < opened->hierarchy()->nodeCount(); ++node)
  {
    const auto columns = opened->read(node, { 0 });
    ASSERT_TRUE(columns.ok());
    for (std::size_t i = 0; i < columns->size(); ++i, ++seen)
    {
      std::int32_t number = 0;
      std::memcpy(&number, columns->columns[0].data() + sizeof number * i, sizeof number);
      const auto steps = columns->origin + pointfront::GridPosition(columns->positions[i]);
      ASSERT_EQ(opened->description().grid.toWorld(steps).x, number);
      ASSERT_TRUE(number % 10 != 3 && number % 10 != 7) << number;
    }
  }
  EXPECT_EQ(seen, 56000u);
}

/// Points of a program's memory have no system by nature; files might have named one.
TEST_F(PointSets, OnlyFilesAreAskedForAReferenceSystemByThePropertysName)
{
  setRow(100);
  ASSERT_EQ(builder->Write(), 1);
  EXPECT_EQ(warnings().find("reference system"), std::string::npos) << warnings();
  const fs::path text = folder / "some.xyz";
  std::ofstream(text) << "1 2 3\n4 5 6\n7 8 10\n";
  builder->SetPoints(nullptr);
  builder->AddFileName(text.c_str());
  ASSERT_EQ(builder->Write(), 1);
  EXPECT_NE(warnings().find("AssumedCRS"), std::string::npos) << warnings();
  EXPECT_EQ(warnings().find("--"), std::string::npos) << warnings();
}

} // namespace
