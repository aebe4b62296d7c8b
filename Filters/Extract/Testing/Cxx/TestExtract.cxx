#include "ErrorObserver.h"
#include "vtkPointFrontBuilder.h"
#include "vtkPointFrontExtract.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPlanes.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

namespace
{

namespace fs = std::filesystem;
const std::string stadium = POINTFRONT_TEST_DATA "/autzen_stadium.laz";

class Extract : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    folder = fs::path(testing::TempDir()) / ("pointfront-extract-" + std::to_string(getpid()));
    fs::create_directories(folder);
    store = (folder / "stadium.pfront").string();
    vtkNew<vtkPointFrontBuilder> builder;
    builder->AddFileName(stadium.c_str());
    builder->SetOutputFileName(store.c_str());
    builder->SetNodePoints(1000);
    builder->OverwriteOn();
    ASSERT_EQ(builder->Write(), 1);
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }
  void SetUp() override { filter->SetFileName(store.c_str()); }

  vtkPolyData* updated()
  {
    filter->Update();
    EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::NoError);
    return filter->GetOutput();
  }
  /// The whole store: as many times as a test likes.
  static vtkPolyData* whole()
  {
    static vtkNew<vtkPointFrontExtract> all;
    all->SetFileName(store.c_str());
    all->Update();
    return all->GetOutput();
  }
  /// Ids of the whole store's points that pass.
  static std::vector<vtkIdType> expected(const std::function<bool(const double*, vtkIdType)>& pass)
  {
    std::vector<vtkIdType> ids;
    for (vtkIdType i = 0; i < whole()->GetNumberOfPoints(); ++i)
    {
      double p[3];
      whole()->GetPoint(i, p);
      if (pass(p, i))
      {
        ids.push_back(i);
      }
    }
    return ids;
  }
  static std::vector<vtkIdType> idsOf(vtkPolyData* data)
  {
    auto* const ids = vtkIdTypeArray::SafeDownCast(data->GetPointData()->GetGlobalIds());
    EXPECT_TRUE(ids);
    return { ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfValues() };
  }

  static fs::path folder;
  static std::string store;
  vtkNew<vtkPointFrontExtract> filter;
};

fs::path Extract::folder;
std::string Extract::store;

TEST_F(Extract, GivesThePointsOfARegionWithTheirAttributesAndIds)
{
  const double infinity = std::numeric_limits<double>::infinity();
  filter->UseBoxOn();
  filter->SetBox(637100, 637300, 851500, 851800, -infinity, infinity);
  filter->UseSphereOn();
  filter->SetSphereCenter(637200, 851600, 450);
  filter->SetSphereRadius(120);
  vtkPolyData* const some = updated();
  const auto ids = expected(
    [](const double* p, vtkIdType)
    {
      return p[0] >= 637100 && p[0] <= 637300 && p[1] >= 851500 && p[1] <= 851800 &&
        std::hypot(p[0] - 637200, std::hypot(p[1] - 851600, p[2] - 450)) <= 120;
    });
  ASSERT_GT(ids.size(), 500u);
  ASSERT_EQ(idsOf(some), ids);
  EXPECT_STREQ(some->GetPointData()->GetGlobalIds()->GetName(), "point_id");
  EXPECT_EQ(some->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(some->GetNumberOfVerts(), some->GetNumberOfPoints());
  EXPECT_STREQ(some->GetPointData()->GetScalars()->GetName(), "rgb");
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(some), ""); // it is not the store
  for (int a = 0; a < whole()->GetPointData()->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* const all = whole()->GetPointData()->GetArray(a);
    vtkDataArray* const chosen = some->GetPointData()->GetArray(all->GetName());
    ASSERT_TRUE(chosen) << all->GetName();
    ASSERT_EQ(chosen->GetDataType(), all->GetDataType());
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      ASSERT_EQ(chosen->GetComponent(static_cast<vtkIdType>(i), 0), all->GetComponent(ids[i], 0));
    }
  }
  EXPECT_LT(filter->GetNumberOfPointsRead(), whole()->GetNumberOfPoints() / 2);
  EXPECT_GT(filter->GetNumberOfNodesRead(), 0);
  EXPECT_GT(filter->GetNumberOfBytesRead(), 1000);
}

TEST_F(Extract, TakesClassesConditionsPlanesAndAreas)
{
  filter->AddObjectClass(0); // all that this cloud has
  filter->AddObjectClass(5);
  filter->SetWhere("intensity in [20, 90)");
  vtkNew<vtkPlanes> planes; // normals outwards
  planes->SetBounds(637000, 637500, 851400, 852000, 0, 460);
  filter->SetFrustum(planes);
  filter->SetWellKnownText("POLYGON ((636900.001 851400.001, 637400.001 851400.001, "
                           "637400.001 851900.001, 636900.001 851900.001, "
                           "636900.001 851400.001))");
  vtkDataArray* const intensity = whole()->GetPointData()->GetArray("intensity");
  const auto ids = expected(
    [&](const double* p, vtkIdType i)
    {
      const double value = intensity->GetComponent(i, 0);
      return value >= 20 && value < 90 && p[0] >= 637000 && p[0] < 637400.001 &&
        p[1] > 851400.001 && p[1] < 851900.001 && p[2] <= 460;
    });
  ASSERT_GT(ids.size(), 500u);
  EXPECT_EQ(idsOf(updated()), ids);
  filter->ClearObjectClasses();
  filter->AddObjectClass(5);
  EXPECT_EQ(updated()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->GetArray("intensity")); // without values
}

TEST_F(Extract, ASpacingThinsOutAndALimitIsKept)
{
  filter->SetSpacing(20.0);
  const vtkIdType points = updated()->GetNumberOfPoints();
  EXPECT_GT(points, 100);
  EXPECT_LT(points, whole()->GetNumberOfPoints() / 4);
  vtkNew<ErrorObserver> errors;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->SetMaximumNumberOfPoints(points - 1);
  filter->Update();
  EXPECT_TRUE(errors->GetError());
  EXPECT_NE(errors->GetErrorMessage().find("MaximumNumberOfPoints"), std::string::npos);
  filter->SetMaximumNumberOfPoints(points);
  EXPECT_EQ(updated()->GetNumberOfPoints(), points);
}

TEST_F(Extract, CountsWithoutGivingPoints)
{
  filter->SetWhere("intensity > 100");
  filter->CountOnlyOn();
  filter->SetMaximumNumberOfPoints(1);
  EXPECT_EQ(updated()->GetNumberOfPoints(), 0);
  const vtkIdType counted = filter->GetNumberOfPointsChosen();
  const vtkTypeInt64 bytes = filter->GetNumberOfBytesRead();
  filter->CountOnlyOff();
  filter->SetMaximumNumberOfPoints(VTK_ID_MAX);
  EXPECT_EQ(updated()->GetNumberOfPoints(), counted);
  EXPECT_GT(counted, 0);
  EXPECT_LT(counted, whole()->GetNumberOfPoints());
  EXPECT_EQ(filter->GetNumberOfPointsChosen(), counted);
  EXPECT_LT(bytes, filter->GetNumberOfBytesRead());
}

TEST_F(Extract, PiecesTogetherAreTheWhole)
{
  filter->SetWhere("z < 450");
  const auto ids = idsOf(updated());
  std::vector<vtkIdType> together;
  for (int piece = 0; piece < 3; ++piece)
  {
    filter->UpdatePiece(piece, 3, 0);
    const auto some = idsOf(filter->GetOutput());
    EXPECT_GT(some.size(), ids.size() / 6);
    together.insert(together.end(), some.begin(), some.end());
  }
  EXPECT_EQ(together, ids);
}

TEST_F(Extract, GivesPointsByTheirIds)
{
  vtkNew<vtkIdTypeArray> wanted;
  for (const vtkIdType id : { 100000, 5, 77, 5 })
  {
    wanted->InsertNextValue(id);
  }
  filter->SetPointIds(wanted);
  filter->SetPointArrayStatus("intensity", 0);
  vtkPolyData* const picked = updated();
  EXPECT_EQ(idsOf(picked), (std::vector<vtkIdType>{ 5, 77, 100000 }));
  EXPECT_FALSE(picked->GetPointData()->GetArray("intensity"));
  EXPECT_TRUE(picked->GetPointData()->GetArray("classification"));
  double p[3];
  double q[3];
  picked->GetPoint(1, p);
  whole()->GetPoint(77, q);
  EXPECT_TRUE(p[0] == q[0] && p[1] == q[1] && p[2] == q[2]);
  vtkNew<ErrorObserver> errors;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  wanted->InsertNextValue(-1);
  wanted->Modified();
  filter->Update();
  EXPECT_TRUE(errors->GetError());
}

TEST_F(Extract, FindsTheStoreByTheReadersOutput)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(store.c_str());
  reader->SetOverviewPoints(100);
  filter->SetFileName(nullptr);
  filter->SetInputConnection(reader->GetOutputPort());
  EXPECT_EQ(updated()->GetNumberOfPoints(), whole()->GetNumberOfPoints());
}

/// VTK passes field data on, but what is extracted is not the store: a mapper would draw all of it.
TEST_F(Extract, DoesNotPassTheStoresNameOn)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(store.c_str());
  reader->SetOverviewPoints(100);
  filter->SetFileName(nullptr);
  filter->SetInputConnection(reader->GetOutputPort());
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(updated()), std::string());
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(reader->GetOutput()), store);
}

TEST_F(Extract, OnlyWhatChangesRunsAgain)
{
  filter->SetSpacing(20.0);
  const vtkMTimeType before = updated()->GetMTime();
  EXPECT_EQ(updated()->GetMTime(), before);
  vtkNew<vtkPlanes> planes;
  planes->SetBounds(637000, 637500, 851400, 852000, 0, 460);
  filter->SetFrustum(planes);
  const vtkIdType points = updated()->GetNumberOfPoints();
  planes->SetBounds(637000, 637100, 851400, 851500, 0, 460);
  EXPECT_LT(updated()->GetNumberOfPoints(), points);
}

TEST_F(Extract, TellsProgressAndStopsWhenItIsAborted)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->AbortExecuteOn(); });
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->SetMemoryLimit(1 << 20); // many rounds
  filter->Update();
  EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  filter->SetMemoryLimit(1 << 30); // through before the first report is due
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST_F(Extract, SaysWhatIsWrong)
{
  vtkNew<ErrorObserver> errors;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto said = [&](const char* part)
  {
    errors->Clear();
    filter->Update();
    EXPECT_NE(errors->GetErrorMessage().find(part), std::string::npos) << errors->GetErrorMessage();
    EXPECT_NE(filter->GetErrorCode(), vtkErrorCode::NoError);
  };
  filter->SetWhere("nonsense > 3");
  said("nonsense");
  filter->SetWhere(nullptr);
  filter->SetWellKnownText("POLYGON ((0 0, 1 0))");
  said("well-known text");
  filter->SetWellKnownText("LINESTRING (0 0, 1 0)");
  said("line distance");
  filter->SetWellKnownText("SRID=4326;POLYGON ((0 0, 1 0, 1 1, 0 0))");
  said("EPSG:4326");
  filter->SetWellKnownText(nullptr);
  filter->UseBoxOn();
  filter->SetBox(0.0, 1.0, 2.0, 1.5, 0.0, 1.0);
  said("along y (2 above 1.5)");
  filter->UseBoxOff();
  filter->UseSphereOn();
  filter->SetSphereRadius(-1.0);
  said("radius");
  filter->UseSphereOff();
  filter->AddObjectClass(2);
  filter->AddObjectClass(256);
  said("class 256");
  filter->ClearObjectClasses();
  filter->SetMemoryLimit(1000);
  said("memory");
  filter->SetFileName((folder / "none.pfront").string().c_str());
  said("none.pfront");
  filter->SetFileName(nullptr);
  said("no store");
}

} // namespace
